"""A shell is told what may come next."""

import os
import subprocess
import sys

import pytest
from terminal import Run

from tween import gallery


def completed(run: Run, monkeypatch: pytest.MonkeyPatch, *words: str) -> set[str]:
    """What bash offers after some words, the last of which is incomplete."""
    monkeypatch.setenv("_TWEEN_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", " ".join(["tween", *words]))
    monkeypatch.setenv("COMP_CWORD", str(len(words)))
    status, out, err = run("")
    assert (status, err) == (0, "")
    return set(out.split())


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (("mo",), {"plain,morph"}),
        (("info", "gallery:horse"), {"plain,gallery:horseshoe"}),
        (("gallery", "pretz"), {"plain,pretzel"}),
        (("morph", "gallery:ell", "dis"), {"plain,disk"}),
        (("morph", "--strat"), {"plain,--strategy"}),
        (("morph", "--strategy", "m"), {"plain,matched"}),
        (("info", "drawing"), {"file,drawing"}),
        (("info", "gallery:ell", "-o", "why"), {"file,why"}),
        (("certify", "m"), {"file,m"}),
    ],
)
def test_what_may_come_next_is_offered(
    words: tuple[str, ...], offered: set[str], run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert completed(run, monkeypatch, *words) == offered


def test_every_curve_that_comes_with_tween_is_offered(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    offered = completed(run, monkeypatch, "info", "gallery:")
    assert offered == {f"plain,gallery:{name}" for name in gallery.names()}


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_the_script_of_a_shell_is_printed(shell: str, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_TWEEN_COMPLETE", f"{shell}_source")
    status, out, err = run("")
    assert (status, err) == (0, "")
    assert f"_TWEEN_COMPLETE={shell}_complete" in out


def test_another_shell_is_refused(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_TWEEN_COMPLETE", "tcsh_source")
    status, out, err = run("")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "bash_source, zsh_source or fish_source" in err


def test_completing_a_command_waits_for_no_import() -> None:
    code = "import sys; from tween.app.command_line.main import main; main([]); print(*sys.modules, file=sys.stderr)"
    env = {**os.environ, "_TWEEN_COMPLETE": "bash_complete", "COMP_WORDS": "tween mo", "COMP_CWORD": "1"}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, check=True)
    assert done.stdout == "plain,morph\n"
    assert not {name.partition(".")[0] for name in done.stderr.split()} & {"numpy", "numba", "matplotlib"}
