"""What all tests share: laws made at run time are kept apart from the user's own."""

import os

import pytest


@pytest.fixture(scope="session", autouse=True)
def _laws_of_the_session(tmp_path_factory):
    """One folder of compiled laws for the session, so that each is compiled once."""
    before = os.environ.get("TISSU_CACHE")
    os.environ["TISSU_CACHE"] = str(tmp_path_factory.mktemp("tissu-cache"))
    yield
    if before is None:
        del os.environ["TISSU_CACHE"]
    else:
        os.environ["TISSU_CACHE"] = before
