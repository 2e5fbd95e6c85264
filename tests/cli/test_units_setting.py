"""The unit check can be set to warn, and the setting decides what is taken from the cache."""

from pathlib import Path

from typer.testing import CliRunner

from lacuna.cli.main import app

MODEL = """model Decay
  Real x(unit="m", start=1, fixed=true);
equation
  der(x) = -x;
end Decay;
"""


def test_units_as_error_and_as_warning(tmp_path: Path, monkeypatch):
    monkeypatch.setenv("LACUNA_CACHE", str(tmp_path / "cache"))
    file = tmp_path / "Decay.mo"
    file.write_text(MODEL)
    refused = CliRunner().invoke(app, ["compile", str(file)])
    warned = CliRunner().invoke(app, ["compile", str(file), "--units", "warn"])
    again = CliRunner().invoke(app, ["compile", str(file)])
    assert (refused.exit_code, warned.exit_code, again.exit_code) == (1, 0, 1)
    assert "error[U001]" in refused.output
    assert "warning[U001]" in warned.output
