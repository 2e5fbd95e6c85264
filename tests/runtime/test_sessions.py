"""A session serves one thread at a time."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
import signal
import threading

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.events.models import compiled

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


def test_what_a_handler_of_another_signal_raises_ends_the_run(tmp_path: Path) -> None:
    """Chatter that goes on for minutes, and an alarm after a second: its handler runs where the runtime looks up."""
    text = "model C Real x(start=1, fixed=true); equation der(x) = noEvent(if x > 0 then -1 else 1); end C;"
    model = compiled(tmp_path, text)

    def over(*_: object) -> None:
        raise TimeoutError("over")

    before = signal.signal(signal.SIGALRM, over)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    try:
        with pytest.raises(TimeoutError, match="over"):
            runtime.simulate(model, solver="rodas4", stop=2000.0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
