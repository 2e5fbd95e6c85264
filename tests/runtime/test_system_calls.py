"""What the compiled libraries ask of the system: memory, the clock, a model's library; no file, process or network.

So of the system calls only these can fail: memory (test_allocations.cpp, a trap for each), and loading a library
(below). All files are read and written by Python, where tests/faults makes each call fail.
"""

from __future__ import annotations

from pathlib import Path
import re
import subprocess

import pytest

from lacuna import runtime
from lacuna.native import native_library

SYSTEM = {"malloc", "calloc", "realloc", "free", "clock_gettime", "dlopen", "dlclose", "dlerror", "dlsym"}
LOCKS = {"pthread_mutex_lock", "pthread_mutex_unlock"}
TEXTS = re.compile(r"mem(cmp|cpy|move|set)|str(cmp|len|str)|v?snprintf")
MATHEMATICS = re.compile(
    r"f(max|min|abs|mod)|frexp|ldexp|pow|sqrt|hypot|exp|log2?|log10|l?l?round|floor|ceil|trunc|erfc?|a?(sin|cos|tan)h?"
)
OF_LANGUAGES = re.compile(r"_ITM_.*|__cxa_.*|__gmon_start__|__gxx_.*|_Unwind_.*|_Z.*|__popcountdi2|__stack_chk_fail")
OF_LIBRARIES = re.compile(r"IDA.*|SUN.*|N_V.*|klu_.*|fftw_.*")


@pytest.mark.parametrize("name", ["lacuna_runtime", "lacuna_analysis"])
def test_no_library_reaches_for_files_processes_or_the_network(name: str) -> None:
    listed = subprocess.run(
        ["nm", "-D", "--undefined-only", native_library(name)], check=True, capture_output=True, text=True
    )
    symbols = {line.split()[-1].partition("@")[0] for line in listed.stdout.splitlines()}
    if any(s.startswith(("__gcov", "__asan", "__tsan")) for s in symbols):
        pytest.skip("a build with instruments of its own")
    known = (TEXTS, MATHEMATICS, OF_LANGUAGES, OF_LIBRARIES)
    assert {s for s in symbols - SYSTEM - LOCKS if not any(k.fullmatch(s) for k in known)} == set()
    assert not [s for s in symbols if "stream" in s], "streams of C++ are files, too"


@pytest.mark.parametrize("content", [b"", b"not a library", b"\x7fELF" + bytes(200)])
def test_a_library_that_does_not_load_is_said(content: bytes, tmp_path: Path) -> None:
    library = tmp_path / "model.so"
    library.write_bytes(content)
    with pytest.raises(runtime.SimulationError, match=r"model\.so"):
        runtime.Model(str(library))
