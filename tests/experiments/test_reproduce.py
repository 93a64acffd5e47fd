"""Each step runs once, after those that it reads, its time is told, and the first that fails stops the rest."""

import json
import os
from pathlib import Path
from typing import Any, ClassVar

import pytest

from experiments import reproduce
from experiments.catalogue import STEPS, STUDIES


class Process:
    """Instead of a step: it ends when it has been asked twice."""

    running: ClassVar[set[str]] = set()
    begun: ClassVar[list[tuple[str, dict[str, str]]]] = []
    finished: ClassVar[list[str]] = []
    most = 0
    fails = ""

    def __init__(self, command: list[str], env: dict[str, str], **_: Any) -> None:
        self.module = command[-1].removeprefix("experiments.")
        Process.begun.append((self.module, env))
        after = next(step.after for step in STEPS if step.module == self.module)
        assert set(after) <= set(Process.finished), f"{self.module} reads what is not there yet"
        self.asked, self.returncode = 0, 3 * (self.module == Process.fails)
        Process.running.add(self.module)
        Process.most = max(Process.most, len(Process.running))

    def poll(self) -> int | None:
        self.asked += 1
        if self.asked <= 2:
            return None
        return self.wait()

    def wait(self) -> int:
        Process.running.remove(self.module)
        Process.finished.append(self.module)
        return self.returncode

    def terminate(self) -> None:
        Process.running.remove(self.module)


@pytest.fixture(autouse=True)
def no_step_really_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    Process.running, Process.begun, Process.finished, Process.most, Process.fails = set(), [], [], 0, ""
    monkeypatch.setattr(reproduce.subprocess, "Popen", Process)
    monkeypatch.setattr(reproduce.time, "sleep", lambda _: None)
    monkeypatch.setattr(reproduce, "TIMES", tmp_path / "times.json")


def test_every_step_runs_once_two_side_by_side_and_its_time_is_kept() -> None:
    reproduce.main()
    assert sorted(Process.finished) == sorted(step.module for step in STEPS)
    assert Process.most == 2
    assert [row["step"] for row in json.loads(reproduce.TIMES.read_text())] == [step.title for step in STEPS]


def test_the_longest_that_can_begin_does_and_studies_share_the_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reproduce.os, "cpu_count", lambda: 6)
    reproduce.main()
    begun = [module for module, _ in Process.begun]
    free = sorted((step for step in STEPS if not step.after), key=lambda step: -step.seconds)
    assert [module for module in begun if module in {step.module for step in free}] == [step.module for step in free]
    jobs = {module: env.get("LOKY_MAX_CPU_COUNT") for module, env in Process.begun}
    assert {jobs[step.module] for step in STUDIES} == {"3"}
    assert jobs["claims"] == os.environ.get("LOKY_MAX_CPU_COUNT")


def test_every_step_is_after_steps_that_exist_and_stand_before_it() -> None:
    for i, step in enumerate(STEPS):
        assert set(step.after) <= {earlier.module for earlier in STEPS[:i]}, step.module


def test_a_step_that_fails_is_named_and_ends_everything(capsys: pytest.CaptureFixture[str]) -> None:
    Process.fails = max(STUDIES, key=lambda step: step.seconds).module
    with pytest.raises(SystemExit, match="3"):
        reproduce.main()
    assert f"reproduce: {Process.fails} failed" in capsys.readouterr().err
    assert len(Process.finished) == 2, "the other one that ran came to its end, and no other was begun"


def test_an_interrupt_ends_what_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(reproduce.time, "sleep", interrupted)
    with pytest.raises(KeyboardInterrupt):
        reproduce.main()
    assert (Process.running, Process.finished) == (set(), [])
