"""A terminal in a folder of its own."""

import shlex
from pathlib import Path

import pytest
from terminal import Run

from tween.app.command_line import main as command_line
from tween.app.command_line import stages


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command line in a folder of its own; returns the exit status and what was printed on both streams."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(stages, "PATIENCE", 600.0)  # whether kernels have to be compiled depends on the cache

    def runs(line: str, *words: str) -> tuple[int, str, str]:
        status = command_line.main([*shlex.split(line), *words])
        return (status, *capsys.readouterr())

    return runs
