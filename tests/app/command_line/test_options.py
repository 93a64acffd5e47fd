"""The options: their choices are those of the library, and words become values within their limits."""

from typing import Any

import click
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from terminal import COMMANDS, parsed

from tween.app.command_line import options
from tween.choices import FITS, PACES, PATHS, PLACEMENTS, ROOT_RULES, SIZES, STRATEGIES, STYLES


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ("path", PATHS),
        ("strategy", STRATEGIES),
        ("style", STYLES),
        ("root", ROOT_RULES),
        ("placement", PLACEMENTS),
        ("pace", PACES),
        ("fit", FITS),
    ],
)
def test_every_choice_of_the_library_is_a_choice_of_the_command(option: str, words: tuple[str, ...]) -> None:
    for word in words:
        assert parsed("morph", f"a.csv b.csv -o c.gif --{option} {word}")[option] == word


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        ("", "size", 480),
        ("--size 64", "size", 64),
        ("--size 640x480", "size", (640, 480)),
        ("--root 3", "root", 3),
        ("--root tree-center", "root", "tree-center"),
        ("--landmark 12:40 --landmark 0:7", "landmarks", ((12, 40), (0, 7))),
        ("--frames 2", "frames", 2),
        ("--size small", "size", "small"),
        ("--landmark 1:2:3", "landmarks", ((1, 2, 3),)),
        ("--tolerance 1e-3", "tolerance", 1e-3),
    ],
)
def test_words_become_values(words: str, name: str, value: Any) -> None:
    found = parsed("morph", f"a.csv b.csv -o c.gif {words}")[name]
    assert found == value
    assert type(found) is type(value)


@given(
    st.text(max_size=8).filter(lambda text: not text.startswith("-")),
    st.sampled_from(["--frames", "--fps", "--size", "--root", "--tolerance", "--pen", "--smooth", "--landmark"]),
)
def test_any_text_is_a_value_within_its_limits_or_misuse(text: str, option: str) -> None:
    context = ["a.csv", "b.csv", "-o", "c.gif", option, text]
    try:
        found = COMMANDS["morph"].make_context("tween morph", context).params
    except click.UsageError as misuse:
        assert option in misuse.format_message()
        return
    assert found["frames"] is None or found["frames"] >= 2
    assert 1 <= found["fps"] <= 100
    assert text == "small" or all(SIZES[0] <= side <= SIZES[1] for side in np.atleast_1d(found["size"]))
    assert all(found[name] is None or 0 < found[name] < np.inf for name in ("tolerance", "pen"))
    assert found["smooth"] is None or 0 <= found["smooth"] < np.inf


def test_no_option_is_understood_by_its_beginning() -> None:
    with pytest.raises(click.NoSuchOption, match="--fram"):
        parsed("morph", "a.csv b.csv -o c.gif --fram 3")


def test_options_taken_together_stand_in_the_help_in_their_order() -> None:
    @click.command()
    @options.together(options.flag("--first", help="One."), options.number("--second", "N", "Two.", 1, 3))
    def command() -> None: ...

    assert [parameter.name for parameter in command.params] == ["first", "second"]
    with pytest.raises(click.BadParameter, match="1<=x<=3"):
        command.make_context("command", ["--second", "4"])
