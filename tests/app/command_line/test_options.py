"""The options: what the help says runs, and the choices are those of the library."""

import argparse
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from terminal import Run, parsers

from tween.app.command_line import commands
from tween.app.command_line.options import Misuse, build_parser
from tween.choices import PATHS, PLACEMENTS, ROOT_RULES, SIZES, STRATEGIES, STYLES


def examples(parser: argparse.ArgumentParser) -> list[str]:
    return re.findall(r"^  tween (.+)$", parser.epilog or "", re.MULTILINE)


@pytest.mark.parametrize("name", parsers())
def test_every_example_of_the_help_runs(name: str, run: Run) -> None:
    lines = examples(parsers()[name])
    assert lines
    for line in lines:
        status, out, err = run(line)
        assert (line, status, err) == (line, 0, "")
        assert out


@pytest.mark.parametrize("name", parsers())
def test_help_says_what_a_command_is_for_and_fits_the_page(name: str, run: Run, monkeypatch: Any) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    status, out, err = run(f"{name} --help")
    assert (status, err) == (0, "")
    assert out.startswith("usage: tween")
    options = out.partition("examples:")[0].splitlines()
    assert max(map(len, options)) <= 90


@pytest.mark.parametrize(
    ("option", "words"),
    [("path", PATHS), ("strategy", STRATEGIES), ("style", STYLES), ("root", ROOT_RULES), ("placement", PLACEMENTS)],
)
def test_every_choice_of_the_library_is_a_choice_of_the_command(option: str, words: tuple[str, ...]) -> None:
    for word in words:
        options = build_parser().parse_args(["morph", "a.csv", "b.csv", "-o", "c.gif", f"--{option}", word])
        assert getattr(options, option) == word


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("triangulate", "triangulate gallery:ell -o"),
        ("morph", "morph gallery:ell disk --frames 3 --size 32 -o"),
        ("gallery", "gallery ell -o"),
    ],
)
def test_every_suffix_that_the_help_names_is_written(command: str, line: str, run: Run) -> None:
    words = next(a.help for a in parsers()[command]._actions if a.dest == "output")
    suffixes = re.findall(r"\.[a-z0-9]+\b", words or "")
    assert len(suffixes) >= 4
    for suffix in suffixes:
        status, _, err = run(f"{line} out{suffix}")
        if suffix == ".mp4" and "ffmpeg" in err:
            continue
        assert (suffix, status, err) == (suffix, 0, "")
        assert Path(f"out{suffix}").stat().st_size > 100


def test_every_suffix_that_the_help_names_is_read(run: Run) -> None:
    words = next(a.help for a in parsers()["info"]._actions if a.dest == "file")
    for suffix in re.findall(r"\.[a-z]+\b", words or ""):
        assert run(f"gallery ell -o ell{suffix}")[0] == 0
        assert (suffix, run(f"info ell{suffix}")[0]) == (suffix, 0)


# What words become


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        ("", "size", 480),
        ("--size 64", "size", 64),
        ("--size 640x480", "size", (640, 480)),
        ("--root 3", "root", 3),
        ("--root tree-center", "root", "tree-center"),
        ("--landmark 12:40 --landmark 0:7", "landmarks", [(12, 40), (0, 7)]),
        ("--frames 2", "frames", 2),
        ("--tolerance 1e-3", "tolerance", 1e-3),
    ],
)
def test_words_become_values(words: str, name: str, value: Any) -> None:
    options = build_parser().parse_args(["morph", "a.csv", "b.csv", "-o", "c.gif", *words.split()])
    assert getattr(options, name) == value
    assert type(getattr(options, name)) is type(value)


@given(
    st.text(max_size=8).filter(lambda text: not text.startswith("-")),
    st.sampled_from(["--frames", "--fps", "--size", "--root", "--tolerance", "--landmark"]),
)
def test_any_text_is_a_value_within_its_limits_or_misuse(text: str, option: str) -> None:
    try:
        options = build_parser().parse_args(["morph", "a.csv", "b.csv", "-o", "c.gif", option, text])
    except Misuse as misuse:
        assert option in str(misuse) and "--help" in str(misuse)
        return
    assert options.frames >= 2
    assert 1 <= options.fps <= 100
    assert all(SIZES[0] <= side <= SIZES[1] for side in np.atleast_1d(options.size))
    assert options.tolerance is None or 0 < options.tolerance < np.inf


def test_no_option_is_understood_by_its_beginning() -> None:
    with pytest.raises(Misuse, match="--fram"):
        build_parser().parse_args(["morph", "a.csv", "b.csv", "-o", "c.gif", "--fram", "3"])


def test_every_command_of_the_parser_is_a_function_of_commands() -> None:
    assert [name for name in parsers() if name and not callable(getattr(commands, name, None))] == []
