"""lacuna-analyse: a recording in, features out; and what it says about a recording that it cannot use."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

from lacuna.analysis.settings import PAPER, load_settings
from lacuna.analysis.spectra.chain import Chain
from lacuna.analysis.spectra.library import library_path
from tests.analysis.reference import simulate

PROGRAM = library_path().parents[1] / "bin" / "lacuna-analyse"
HEADER = "time,filter[1].y,filter[2].y,filter[3].y,rotor.w,rotor.phi"


def run(*arguments) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=60)


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "test.csv"
    record = simulate(0.25)
    columns = np.vstack([np.arange(record.shape[1]) / 1e5, record]).T
    np.savetxt(path, columns, delimiter=",", fmt="%.17g", header=HEADER, comments="")
    return path


def test_features_as_json_and_spectra_as_csv(tmp_path, recording):
    done = run(recording, "--settings", PAPER, "--out", tmp_path / "f.json", "--spectrum", tmp_path / "s.csv")
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "f.json").read_text())
    features = Chain(load_settings().text).analyse(simulate(0.25)[:3], simulate(0.25)[4])
    assert [channel["rms"] for channel in found["channels"]] == features.rms.tolist()
    assert [channel["peak_bin"] for channel in found["channels"]] == [44, 44, 44]
    assert found["speed_mean"] == pytest.approx(features.speed_mean, rel=1e-14)
    spectra = np.loadtxt(tmp_path / "s.csv", delimiter=",", skiprows=1)
    np.testing.assert_array_equal(spectra[:, 1:].T, features.held)


def test_standard_output_without_a_file(recording):
    done = run("--settings", PAPER, recording)
    assert json.loads(done.stdout)["turns"] == 11


def test_without_the_angle_there_is_no_speed(tmp_path, recording):
    lines = recording.read_text().replace("rotor.phi", "rotor.other", 1)
    (tmp_path / "r.csv").write_text(lines)
    assert json.loads(run(tmp_path / "r.csv", "--settings", PAPER).stdout)["speed_mean"] is None


def test_bad_input_is_told_and_nothing_is_written(tmp_path, recording):
    truncated = tmp_path / "short.csv"
    truncated.write_text("\n".join(recording.read_text().splitlines()[:500]) + "\n")
    for arguments, message in [
        ([truncated, "--settings", PAPER], "ends after 499 samples"),
        ([tmp_path / "none.csv", "--settings", PAPER], "cannot read"),
        ([recording, "--settings", recording], "settings, line 1"),
        ([recording], "usage"),
        ([recording, "--settings"], "needs a file name"),
        ([recording, "--wrong", PAPER], "unexpected argument --wrong"),
    ]:
        done = run(*arguments, *(["--out", tmp_path / "out.json"] if "--settings" in arguments[1:-1] else []))
        assert done.returncode == 1
        assert message in done.stderr and done.stdout == ""
    assert list(tmp_path.iterdir()) == [truncated]
