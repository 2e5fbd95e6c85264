"""Kinds of machines that the seeds below 200 do not have: seeds from 201 on are of these alone."""

from tests.proof.machines.strangers import electrical, hydraulic, moving, thermal

MACHINES = (*thermal.MACHINES, *hydraulic.MACHINES, *electrical.MACHINES, *moving.MACHINES)
