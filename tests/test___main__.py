"""The command as a program of its own: `python -m tween`."""

import json
import os
import re
import signal
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


def interrupted(folder: Path, *words: str, at: str) -> tuple[int, str]:
    """Interrupt a command when it says what it is doing; returns the exit status and what it said after that."""
    command = [sys.executable, "-m", "tween", *words]
    pipe = subprocess.PIPE
    # what runs in the background of a shell ignores interrupts, and so would its children
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(command, cwd=folder, stdout=pipe, stderr=pipe, text=True, start_new_session=True) as process:
        assert process.stderr
        while at not in process.stderr.readline():
            assert process.poll() is None
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, said = process.communicate(timeout=60)
        return process.returncode, said


@pytest.mark.slow
@pytest.mark.parametrize("name", ["film.gif", "film.svg"])
def test_an_interrupted_film_leaves_what_was_there_and_no_part_of_a_file(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(b"what stood there before")
    words = "morph", "gallery:arrow", "gallery:ell", "-o", name, "--frames", "2000", "--size", "1500", "-v"
    assert interrupted(tmp_path, *words, at="writing") == (130, "tween: interrupted\n")
    assert (tmp_path / name).read_bytes() == b"what stood there before"
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.slow
def test_an_interrupted_warmup_says_so_in_one_line(tmp_path: Path) -> None:
    status, said = interrupted(tmp_path, "warmup", "--jobs", "2", at="compiling")
    assert (status, said.splitlines()[-1]) == (130, "tween: interrupted")
    assert "Traceback" not in said


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="only some systems have a folder that takes no files")
@pytest.mark.parametrize(
    "line",
    [
        "gallery ell -o /proc/out.svg",
        "clean gallery:ell -o /proc/out.csv",
        "info gallery:ell -o /proc/out.svg",
        "triangulate gallery:ell -o /proc/out.obj",
        "morph gallery:ell disk -o /proc/out.npz --frames 2",
    ],
)
def test_a_path_that_cannot_be_written_is_said_in_one_line(line: str) -> None:
    done = program(*line.split())
    assert done.returncode == 2
    assert re.fullmatch(r"tween: /proc/out\.\w+: .+", done.stderr.splitlines()[-1])
    assert len([said for said in done.stderr.splitlines() if not said.startswith("compiling kernels")]) == 1
