"""What is no message of the protocol, and requests without what they need, sent to a server on its standard input."""

from __future__ import annotations

from json import dumps, loads
import subprocess
import sys


def served(*texts: bytes) -> subprocess.CompletedProcess[bytes]:
    sent = b"".join(b"Content-Length: %d\r\n\r\n%b" % (len(text), text) for text in texts)
    command = [sys.executable, "-m", "lacuna.cli.main", "lsp"]
    return subprocess.run(command, input=sent, capture_output=True, check=True)


def test_what_is_no_message_is_told_in_a_line_and_the_next_one_is_answered() -> None:
    """Braces without JSON in them ended in a traceback."""
    asked = b'{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}'
    done = served(b"{abc}", asked)
    assert done.stderr.count(b"\n") == 1 and done.stderr.startswith(b"lacuna lsp: Unable to handle message"), (
        done.stderr
    )
    assert b'"serverInfo"' in done.stdout


def test_a_request_without_what_it_needs_is_answered_by_an_error() -> None:
    """It got no answer at all, and an editor waits."""
    asked = [("initialize", {"capabilities": {}}), ("textDocument/hover", {"bad": 1}), ("shutdown", None)]
    done = served(
        *(dumps({"jsonrpc": "2.0", "id": n, "method": m, "params": p}).encode() for n, (m, p) in enumerate(asked))
    )
    answers = [loads(part[part.index(b"{") :]) for part in done.stdout.split(b"Content-Length")[1:]]
    assert {a["id"]: a["error"]["code"] for a in answers if "error" in a} == {1: -32602}
    assert any(a.get("id") == 2 for a in answers) and b"Traceback" not in done.stderr
