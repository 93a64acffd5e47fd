"""Everything in order: each step runs once, its time is told, and the first that fails stops the rest."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from experiments import reproduce
from experiments.catalogue import STEPS


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """Return the modules that would have been run."""
    modules: list[str] = []

    def run(command: list[str], **_: Any) -> subprocess.CompletedProcess[bytes]:
        modules.append(command[-1])
        return subprocess.CompletedProcess(command, returncode=0)

    monkeypatch.setattr(reproduce.subprocess, "run", run)
    monkeypatch.setattr(reproduce, "TIMES", tmp_path / "times.json")
    return modules


def test_every_step_runs_once_in_order_and_its_time_is_kept(ran: list[str]) -> None:
    reproduce.main()
    assert ran == [f"experiments.{step.module}" for step in STEPS]
    assert [row["step"] for row in json.loads(reproduce.TIMES.read_text())] == [step.title for step in STEPS]


def test_a_step_that_fails_is_named_and_ends_everything(
    ran: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    failed = subprocess.CompletedProcess([], returncode=3)
    monkeypatch.setattr(reproduce.subprocess, "run", lambda *_, **__: failed)
    with pytest.raises(SystemExit, match="3"):
        reproduce.main()
    assert "reproduce: studies.to_disk failed" in capsys.readouterr().err
