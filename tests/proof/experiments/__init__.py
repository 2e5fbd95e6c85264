"""Proof of the proposed experiments: played on the simulated truth, they have to decide."""
