"""Places that the tests need: recorded data beside the repository, and the program of the terminal."""

import os
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def shared():
    """Path of a file of the shared data; skips the test by its name where that is absent."""

    def place(name):
        path = REPOSITORY.parent / "shared" / "data" / name
        if not path.exists():
            pytest.skip(f"no shared data ({name})")
        return path

    return place


@pytest.fixture(scope="session")
def program():
    """The program `pilotage` of the same build: `PILOTAGE_PROGRAM`, or that of a debug build."""
    stated = os.environ.get("PILOTAGE_PROGRAM")
    path = Path(stated) if stated else REPOSITORY / "target" / "debug" / "pilotage"
    if not path.exists():
        if stated:
            pytest.fail(f"{path}: there is no such program")
        pytest.skip("the program of the terminal is not built (cargo build -p pilotage-cli)")
    return path
