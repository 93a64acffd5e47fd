"""The command as a program of its own: `python -m tween`."""

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


# With its output buffered, as it is for people: what could not be written is written once more at the end.
BUFFERED = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}


def program(*words: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-m", "tween", *words], capture_output=True, text=True)


def test_python_runs_the_package() -> None:
    done = program("info", "gallery:ell", "--json")
    assert done.returncode == 0
    assert [line for line in done.stderr.splitlines() if not line.startswith("compiling kernels")] == []
    assert json.loads(done.stdout)["bounds_disk"]
    done = program("info", "none.csv")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("tween: none.csv")


def test_the_version_is_that_of_the_project() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert program("--version").stdout == f"tween {project['version']}\n"
    assert project["scripts"] == {"tween": "tween.app.command_line.main:main"}


@pytest.mark.parametrize("words", [["--version"], ["--help"], ["morph", "--help"], ["frob"], []])
def test_help_and_complaints_wait_for_no_import(words: list[str]) -> None:
    code = (
        f"import sys; from tween.app.command_line.main import main; main({words}); print(*sys.modules, file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.partition(".")[0] for name in done.stderr.splitlines()[-1].split()}
    assert "tween" in loaded
    assert not loaded & {"numpy", "numba", "scipy", "shapely", "matplotlib", "PIL"}


def test_a_reader_that_goes_away_is_no_error() -> None:
    command = [sys.executable, "-m", "tween", "gallery"]
    with subprocess.Popen(command, env=BUFFERED, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert (process.stderr.read(), process.wait()) == (b"", 141)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only some systems have a device that is always full")
def test_an_output_that_cannot_be_written_is_said_in_one_line() -> None:
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "tween", "gallery"]
        done = subprocess.run(command, env=BUFFERED, stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (2, "tween: output: No space left on device\n")
