"""What `make test` counts on: tests of one xdist_group run in one worker, which makes their fixtures once."""

from __future__ import annotations

import os

import pytest


@pytest.mark.skipif("PYTEST_XDIST_WORKER" not in os.environ, reason="one process: there are no groups")
@pytest.mark.xdist_group("groups")
def test_a_group_is_part_of_the_name_by_which_tests_are_dealt_out(request: pytest.FixtureRequest) -> None:
    assert request.node.nodeid.endswith("@groups")
