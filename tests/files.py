"""What tests of files share: fixtures, files made by hand, and the one line that an error is."""

import time
from pathlib import Path

import pytest

from tween.errors import CurveError, FileError

FIXTURES = Path(__file__).parent / "fixtures"


def saved(folder, name, content):
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def complaint(path, read):
    """Return the message of the error that reading has to end with, soon."""
    start = time.process_time()
    with pytest.raises((FileError, CurveError)) as caught:
        read(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message
    assert message.isprintable()
    assert len(message) < len(str(path)) + 500
    assert caught.value.__cause__ is None
    assert caught.value.__suppress_context__  # no second traceback above
    assert time.process_time() - start < 30
    return message.removeprefix(f"{path}: ")


def named(content):
    """Return the name and the points of every outline."""
    return [(outline.name, outline.points) for outline in content.outlines]
