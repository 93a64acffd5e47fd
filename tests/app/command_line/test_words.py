"""Words become values within their limits, and every other word is refused with what was expected."""

from collections.abc import Callable
from typing import Any

import click
import pytest

from tween.app.command_line import words


@pytest.mark.parametrize(
    ("read", "text", "value"),
    [
        (words.landmark, "12:40", (12, 40)),
        (words.landmark, "1:2:3", (1, 2, 3)),
        (words.root, "tree-center", "tree-center"),
        (words.root, "-3", -3),
        (words.size, "640x480", (640, 480)),
        (words.size, "small", "small"),
        (words.length, "1e-3", 1e-3),
        (words.distance, "0", 0.0),
    ],
)
def test_a_word_becomes_its_value(read: Callable[[str], Any], text: str, value: Any) -> None:
    assert read(text) == value


@pytest.mark.parametrize(
    ("read", "text"),
    [
        *((words.landmark, text) for text in ("", "3", "1:", "a:b", "-1:2")),
        *((words.root, text) for text in ("", "disk", "1.5")),
        *((words.size, text) for text in ("", "15", "2049", "64x", "large")),
        *((words.length, text) for text in ("", "0", "-1", "inf", "nan", "wide")),
        *((words.distance, text) for text in ("", "-1", "inf", "nan")),
    ],
)
def test_another_word_is_refused(read: Callable[[str], Any], text: str) -> None:
    with pytest.raises(click.BadParameter, match=r"expected .*, found"):
        read(text)
