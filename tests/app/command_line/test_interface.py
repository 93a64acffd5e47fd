"""The commands: what the help says runs, and what is misspelt is answered."""

import re
from pathlib import Path
from typing import Any

import click
import pytest
from terminal import COMMANDS, Run

from tween.app.command_line import commands


def examples(command: click.Command) -> list[str]:
    return re.findall(r"^  tween (.+)$", command.epilog or "", re.MULTILINE)


def help_of(command: str, option: str) -> str:
    return next(p.help or "" for p in COMMANDS[command].params if isinstance(p, click.Option) and p.name == option)


@pytest.mark.parametrize("name", [name for name in COMMANDS if name not in ("warmup", "play")])
def test_every_example_of_the_help_runs(name: str, run: Run) -> None:
    lines = examples(COMMANDS[name])
    assert lines
    for line in lines:
        status, out, err = run(line)
        assert (line, status) == (line, 0)
        assert all(said.startswith("tween: note: ") for said in err.splitlines())
        assert out


@pytest.mark.parametrize("name", COMMANDS)
def test_help_says_what_a_command_is_for_and_fits_the_page(name: str, run: Run, monkeypatch: Any) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    status, out, err = run(f"{name} --help")
    assert (status, err) == (0, "")
    assert out.startswith(f"Usage: tween {name}".rstrip())
    assert max(map(len, out.partition("Examples:")[0].splitlines())) <= 80


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("triangulate", "triangulate gallery:ell -o"),
        ("morph", "morph gallery:ell disk --frames 3 --size 32 -o"),
        ("gallery", "gallery ell -o"),
        ("clean", "clean gallery:ell --smooth 0.05 -o"),
        ("info", "info gallery:ell -o"),
    ],
)
def test_every_suffix_that_the_help_names_is_written(command: str, line: str, run: Run) -> None:
    suffixes = list(dict.fromkeys(re.findall(r"(?<!d)\.[a-z0-9]+\b", help_of(command, "output"))))
    assert len(suffixes) >= 3
    for suffix in suffixes:
        status, _, err = run(f"{line} out{suffix}")
        if suffix == ".mp4" and "ffmpeg" in err:
            continue
        assert (suffix, status, err) == (suffix, 0, "")
        assert Path(f"out{suffix}").stat().st_size > 100


def test_every_suffix_that_the_help_names_is_read(run: Run) -> None:
    suffixes = re.findall(r"\.[a-z]+\b", (COMMANDS["info"].help or "").partition("FILE is")[2])
    assert len(suffixes) == 6
    for suffix in suffixes:
        assert run(f"gallery ell -o ell{suffix}")[0] == 0
        assert (suffix, run(f"info ell{suffix}")[0]) == (suffix, 0)


def test_commands_are_listed_as_they_are_wanted(run: Run) -> None:
    listed = re.findall(r"^  ([a-z]+)  +[A-Z]", run("--help")[1].partition("Commands:")[2], re.MULTILINE)
    assert listed == ["info", "clean", "triangulate", "morph", "play", "certify", "warmup", "gallery"]


def test_every_command_is_a_function_of_commands() -> None:
    assert [name for name in COMMANDS if name and not callable(getattr(commands, name, None))] == []
    assert sorted(commands.__all__) == sorted(name for name in COMMANDS if name)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("inf gallery:ell", "Did you mean 'info'?"),
        ("moprh", "Did you mean 'morph'?"),
        ("zzzz", "expected one of info, clean"),
        ("morph gallery:ell disk --strategi", "'--strategy'"),
        ("info gallery:horsesho", "did you mean 'horseshoe'?"),
        ("info pair:e_to_i/source", "did you mean 'e_to_l'?"),
        ("info horsesho", "did you mean gallery:horseshoe?"),
        ("info galery:ell", "did you mean gallery:ell?"),
        ("gallery pretzl", "did you mean 'pretzel'?"),
    ],
)
def test_what_is_misspelt_is_answered_by_what_may_be_meant(line: str, words: str, run: Run) -> None:
    status, out, err = run(line)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert words in err
