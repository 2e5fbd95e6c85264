"""Recorded tests assessed on a map of the hand-written simulation: right, sure, or refused with the reason."""

from __future__ import annotations

import json
import shutil
import subprocess

import numpy as np
import pytest
from scipy.io import savemat

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.recording.recordings import Refusal
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.assessment import assess, chain_at, low_pass
from lacuna.analysis.severity.severity_table import SeverityTable
from lacuna.analysis.spectra.library import library_path
from tests.analysis.reference import declared, simulate

COLUMNS = ["ia", "ib", "ic"]
ONBOARD = library_path().parents[1] / "bin" / "lacuna-onboard"


def write(path, currents, rate=100000):
    columns = np.vstack([np.arange(currents.shape[1]) / rate, currents]).T
    np.savetxt(path, columns, delimiter=",", fmt="%.9g", header="time,ia,ib,ic", comments="")
    return path


@pytest.mark.parametrize("zeta", [0.0, 0.013, 0.1, 0.25, 0.335, 0.49])
def test_severity_in_the_maps_conditions_within_half_a_point(tmp_path, map_folder, zeta):
    found = assess(write(tmp_path / "r.csv", simulate(zeta)[:3]), map_folder, columns=COLUMNS).estimate
    assert found.severity == pytest.approx(zeta, abs=0.005)
    assert found.low <= zeta + 1e-3 and found.high >= zeta - 1e-3


def test_other_sampling_noise_and_converter(tmp_path, map_folder):
    currents = simulate(0.3, step=1 / 20000, rows=20000)[:3]
    noisy = currents + 0.02 * np.random.default_rng(5).normal(size=currents.shape)
    step = 10 / 2**12  # A, of a 12-bit converter
    path = write(tmp_path / "r.csv", step * np.round(noisy / step), rate=20000)
    done = assess(path, map_folder, columns=COLUMNS)
    assert done.estimate.severity == pytest.approx(0.3, abs=0.005)
    assert done.band.name == "red" and "Plan condition-based maintenance" in done.sentence


def test_friction_misleads_the_mean_rms_and_not_the_estimate(tmp_path, map_folder):
    currents = simulate(0.05, tau_c=2 * declared("tau_c"))[:3]
    found = assess(write(tmp_path / "r.csv", currents), map_folder, columns=COLUMNS).estimate
    assert found.paper > 0.3
    assert found.severity == pytest.approx(0.05, abs=0.01)


def test_files_of_an_assessment(tmp_path, map_folder):
    path = tmp_path / "r.mat"
    record = simulate(0.2)
    savemat(path, {"time": np.arange(100000) / 1e5} | dict(zip(COLUMNS, record[:3], strict=True)))
    done = assess(path, map_folder, tmp_path / "out", columns=COLUMNS)
    assert {file.name for file in (tmp_path / "out").iterdir()} == {
        "assessment.json",
        "assessment.svg",
        "assessment.png",
        "report.html",
    }
    content = json.loads((tmp_path / "out" / "assessment.json").read_text())
    assert content["estimate"]["severity"] == done.estimate.severity
    assert content["sentence"].startswith("Static rotor eccentricity ζ is 20.")
    assert content["band"]["name"] == "orange"


def spoilt(record, how):
    a, b, c = record
    dead = np.full_like(a, 0.01)
    gap = np.where(np.arange(len(a)) == 5000, np.nan, a)
    return np.array(
        {
            "swapped": (b, a, c),
            "rotated": (b, c, a),
            "reversed": (-a, -b, -c),
            "one reversed": (a, -b, c),
            "saturated": (a, np.clip(b, -5, 0.8), c),
            "dead": (a, dead, c),
            "gap": (gap, b, c),
            "late": tuple(np.roll(x, -40000) for x in record),
            "short": tuple(x[:90000] for x in record),
        }[how]
    )


@pytest.mark.parametrize("zeta", [0.0, 0.4])
@pytest.mark.parametrize(
    ("how", "reason"),
    [
        ("swapped", "ib holds the current of ia, ia holds the current of ib"),
        ("rotated", "ic holds the current of ia"),
        ("reversed", "ia is reversed, ib is reversed, ic is reversed"),
        ("one reversed", "reversed: ib is reversed$"),
        ("dead", "ib: constant at 0.01 A"),
        ("gap", r"ia: 1 samples are missing, the first at 0\.05 s"),
        ("late", "not those of this test"),
        ("short", r"0\.9 s long; the test takes 1 s"),
    ],
)
def test_refusals_say_what_is_wrong(tmp_path, map_folder, zeta, how, reason):
    path = write(tmp_path / "r.csv", spoilt(simulate(zeta)[:3], how))
    with pytest.raises(Refusal, match=reason):
        assess(path, map_folder, tmp_path / "out", columns=COLUMNS)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("bits", [0, 12])
def test_a_saturated_channel_is_refused_and_a_quantised_one_is_not(tmp_path, map_folder, bits):
    def converted(x):
        return np.round(x / (10 / 2**bits)) * (10 / 2**bits) if bits else x

    record = simulate(0.4)[:3]
    assess(write(tmp_path / "good.csv", converted(record)), map_folder, columns=COLUMNS)
    with pytest.raises(Refusal, match="ib: saturated at its upper limit"):
        assess(write(tmp_path / "bad.csv", converted(spoilt(record, "saturated"))), map_folder, columns=COLUMNS)


def test_a_map_drawn_anew_must_be_prepared_anew(tmp_path, map_folder):
    shutil.copytree(map_folder, tmp_path / "map")
    with (tmp_path / "map" / "map.csv").open("a") as file:
        file.write("\n")
    with pytest.raises(AnalysisError, match="prepare it again"):
        assess(write(tmp_path / "r.csv", simulate(0.1)[:3]), tmp_path / "map", columns=COLUMNS)


@pytest.mark.parametrize("name", ["expected.npz", "severity.table", "settings.toml"])
@pytest.mark.parametrize("harm", ["cut", "flip", "empty"])
def test_a_damaged_map_is_refused(tmp_path, map_folder, name, harm):
    """Whatever file is harmed: an error that names it, or the same reading; never another one."""
    shutil.copytree(map_folder, tmp_path / "map", ignore=shutil.ignore_patterns("rows"))
    path, recording = tmp_path / "map" / name, write(tmp_path / "r.csv", simulate(0.1)[:3])
    data = bytearray(path.read_bytes())
    if harm == "flip":
        data[len(data) // 3] ^= 0x10
    path.write_bytes({"cut": data[: len(data) // 2], "flip": data, "empty": b""}[harm])
    with pytest.raises(AnalysisError, match=r"map|expected\.npz|severity\.table|settings\.toml"):
        assess(recording, tmp_path / "map", columns=COLUMNS)


def test_a_recording_unlike_most_is_read_with_a_warning(tmp_path, map_folder):
    """Between doubtful and improbable: a supply that is off by a little more than the nuisances allow."""
    found = []
    for share in np.linspace(1.0, 1.4, 9):
        try:
            path = write(tmp_path / "r.csv", simulate(0.1, V=share * declared("V"))[:3])
            found.append(assess(path, map_folder, columns=COLUMNS).warnings)
        except Refusal as refusal:
            assert "standard deviations" in str(refusal)
            found.append(None)
    assert found[0] == () and found[-1] is None
    warned = [warnings for warnings in found if warnings]
    assert warned and "standard deviations" in warned[0][0]


def test_another_actuator_is_refused(tmp_path, map_folder):
    currents = simulate(0.1, Ke=0.08, R=1.0, pp=4.0)[:3]
    with pytest.raises(Refusal, match=r"no severity of the map explains|not those of this test"):
        assess(write(tmp_path / "r.csv", currents), map_folder, columns=COLUMNS)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "no row of numbers"),
        ("time,ia,ib,ic\n", "no row of numbers"),
        ("time,ia,ib\n0,1,2\n", "there is no ic"),
        ("time,ia,ib,ic\n0,1,2\n1,2,3,4\n", ":2: 4 columns in the header, 3 in the rows|:3: 4 fields"),
        ("time,ia,ib,ic\n0,1,2\n1,2,3\n", "4 columns in the header, 3 in the rows"),
        ("time,ia,ib,ic\n0,1,2,3\n1,x,2,3\n", ":3: field 2, `x`, is no number"),
        ("time,ia,ib,ic\n0,1,2,3\n1e-4,1,2,3\n5e-4,1,2,3\n6e-4,1,2,3\n7e-4,1,2,3", "not uniform: at 0.0001 s"),
        ("time,ia,ib,ic\n0,1,2,3\nnan,1,2,3\n", "time has missing values"),
        ("time,ia,ib,ic\n0,1,2,3\n0,1,2,3\n0,1,2,3\n0.1,1,2,3\n", "at 0 s the next sample is 0 s later"),
        ("time,ia,ib,ic\n5,1,2,3\n5,1,2,3\n", "the next sample is 0 s later"),
        ("\x00\x01\x02", "no text"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_broken_files_are_refused(tmp_path, map_folder, text, reason):
    path = tmp_path / "r.csv"
    path.write_text(text)
    with pytest.raises(Refusal, match=reason):
        assess(path, map_folder, columns=COLUMNS)


@pytest.mark.parametrize("harm", ["bits", "digits", "cut"])
def test_a_fuzzed_recording_is_refused_warned_of_or_read_rightly(tmp_path, map_folder, harm):
    random = np.random.default_rng(8)
    currents = simulate(0.2, step=1 / 5000, rows=5000)[:3]
    whole = write(tmp_path / "r.csv", currents + 0.02 * random.normal(size=currents.shape), rate=5000).read_bytes()
    digits = [k for k, byte in enumerate(whole) if chr(byte).isdigit()]
    refused = 0
    for _ in range(12):
        data = bytearray(whole)
        for _ in range(random.choice([1, 5, 50])):
            if harm == "bits":
                data[random.integers(len(data))] ^= 1 << random.integers(8)
            elif harm == "digits":
                data[random.choice(digits)] = ord("0") + random.integers(10)
        if harm == "cut":
            data = data[: random.integers(len(data))]
        (tmp_path / "f.csv").write_bytes(data)
        try:
            done = assess(tmp_path / "f.csv", map_folder, columns=COLUMNS)
        except Refusal:
            refused += 1
        else:
            assert done.warnings or done.estimate.severity == pytest.approx(0.2, abs=0.015)
    assert refused >= 5


def test_an_endless_file_is_refused(tmp_path, map_folder):
    with (tmp_path / "r.csv").open("wb") as file:
        file.truncate(5 << 30)  # a hole: takes no space
    for path in (tmp_path / "r.csv", "/dev/zero"):
        with pytest.raises(Refusal, match=r"larger than 1024 MB|is not a file"):
            assess(path, map_folder, columns=COLUMNS)


def test_a_broken_mat_file_is_refused(tmp_path, map_folder):
    (tmp_path / "r.mat").write_bytes(b"MATLAB 5.0 MAT-file" + bytes(100))
    with pytest.raises(Refusal):
        assess(tmp_path / "r.mat", map_folder, columns=COLUMNS)


def test_filter_for_unfiltered_currents_has_the_response_of_three_sections():
    settings, rate = load_settings(), 20000.0
    time = np.arange(20000) / rate
    for frequency in (33.5, 100.0, 300.0):
        tone = np.cos(2 * np.pi * frequency * time)[None]
        out = low_pass(tone, rate, settings)[0, 10000:]
        gain = abs(1 / (1 + 1j * frequency / 129.7)) ** 3
        assert np.sqrt(2 * (out**2).mean()) == pytest.approx(gain, rel=5e-3)


def test_the_onboard_program_equals_the_desktop(tmp_path, map_folder):
    currents = simulate(0.27)[:3]
    path = write(tmp_path / "r.csv", currents)
    done = subprocess.run([ONBOARD, map_folder / "severity.table"], stdin=path.open(), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    stored = np.loadtxt(path, delimiter=",", skiprows=1).T[1:]
    settings = load_settings(map_folder / "settings.toml")
    expected = SeverityTable(map_folder / "severity.table").estimate(chain_at(settings, 1e5).analyse(stored))
    for name in ("severity", "low", "high", "paper"):
        assert found[name] == pytest.approx(getattr(expected, name), abs=1e-9)
    assert found["misfit"] == pytest.approx(expected.misfit, rel=1e-6, abs=1e-6)
    assert found["band"] == "red" and found["covered"] is True


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time,ia,ib,ic\n0,1,2,3\n", "ended before one record"),
        ("time,ia,ib,ic\n0,1,2\n", "line 2 is not time and currents"),
        ("0,1,2,3\n1e-5,1,x,3\n", "line 2 is not time and currents"),
        ("0,1,2,3\n2e-5,1,2,3\n", "line 2: a sample is missing"),
        ("\x00" * 5000, "line 1"),
    ],
)
def test_the_onboard_program_refuses_what_it_cannot_use(map_folder, text, reason):
    done = subprocess.run([ONBOARD, map_folder / "severity.table"], input=text, capture_output=True, text=True)
    assert done.returncode == 1 and reason in done.stderr and done.stdout == ""


def test_the_onboard_program_refuses_a_damaged_table(tmp_path, map_folder):
    data = bytearray((map_folder / "severity.table").read_bytes())
    data[len(data) // 2] ^= 1
    (tmp_path / "t").write_bytes(data)
    done = subprocess.run([ONBOARD, tmp_path / "t"], input="", capture_output=True, text=True)
    assert done.returncode == 1 and "checksum" in done.stderr
