"""A session serves one thread at a time."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
import threading

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

SERVO = Path(__file__).parents[1] / "models" / "SquareWaveServo.mo"


def test_a_session_that_is_in_use_is_refused() -> None:
    """Two runs of one session at once ended the process."""
    session = runtime.Session(runtime.Model(compile_model(str(SERVO)).path), interval=10.0, patience=1e6)
    entered, left = threading.Event(), threading.Event()

    def hold(time: float) -> None:
        entered.set()
        left.wait()
        session.run(stop=0.1)  # within a run

    with ThreadPoolExecutor() as pool:
        first = pool.submit(session.run, stop=1e5, watch=hold)
        entered.wait()
        try:
            for use in (
                partial(session.run, stop=0.1),
                partial(session.set_parameters, {}),
                partial(session.set_inputs, {}),
            ):
                with pytest.raises(runtime.SimulationError, match="this session is in use: a thread, and what"):
                    use()
        finally:
            left.set()
        with pytest.raises(runtime.SimulationError, match="this session is in use"):
            first.result()
    assert session.run(stop=0.1).complete
