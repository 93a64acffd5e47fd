"""What is being done is said on standard error, and outputs that cannot be written are refused before the work."""

import time
from pathlib import Path

import numba
import pytest
from terminal import Run

from tween.app.command_line import stages
from tween.errors import FileError


def test_what_is_being_done_is_said_on_stderr_when_asked(run: Run) -> None:
    line = "morph gallery:ell disk -o m.npz --certify"
    status, quiet, err = run(line)
    assert (status, err) == (0, "")
    status, out, err = run(f"{line} --verbose")
    assert (status, out) == (0, quiet)
    assert [words.split()[0] for words in err.splitlines()] == ["reading", "matching", "certifying", "writing"]


def compiled() -> None:
    """Compile a kernel of our own, without a cache."""

    @numba.njit
    def square(x):  # type: ignore[no-untyped-def]
        return x * x

    square(2.0)


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
def test_that_kernels_are_compiled_is_said_once_even_to_a_pipe(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(stages, "PATIENCE", 0.0)
    with stages.announcing():
        compiled()
        time.sleep(0.1)
        compiled()
        compiled()
    assert capsys.readouterr().err == f"{stages._WHY_LONG}\n"
    with stages.announcing():
        time.sleep(0.1)
    assert capsys.readouterr().err == ""


def test_what_cannot_be_written_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("in.svg").write_text("")
    Path("folder.svg").mkdir()
    stages.check_output(None, [".svg"], [])
    stages.check_output("out.SVG", [".svg"], ["in.svg"])
    for output, words in [
        ("out.png", "ends in one of .svg"),
        ("no/out.svg", "no folder 'no'"),
        ("folder.svg", "it is a folder"),
        ("./in.svg", "it is the input"),
    ]:
        with pytest.raises(FileError, match=words):
            stages.check_output(output, [".svg"], ["in.svg"])
