"""Every word that stands in a list of choices is taken, and every other word is refused with the list."""

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import pytest

import tween
from tween import choices
from tween.plot.film import record

SQUARE = [(0, 0), (3, 0), (3, 2), (0, 2)]
OPTIONS = {
    "path": choices.PATHS,
    "root": choices.ROOT_RULES,
    "strategy": choices.STRATEGIES,
    "placement": choices.PLACEMENTS,
    "pace": choices.PACES,
}
OF_THE_PAPER = {
    "path": choices.PATHS,
    "root": choices.ROOT_RULES,
    "order": choices.ORDERS,
    "shifts": choices.SHIFT_RULES,
    "pace": choices.PACES,
}
CALLS = [(tween.morph, o, words) for o, words in OPTIONS.items()]
CALLS += [(tween.paper_morph, o, words) for o, words in OF_THE_PAPER.items()]


@pytest.mark.parametrize(("call", "option", "word"), [(call, o, w) for call, o, words in CALLS for w in words])
def test_a_morph_takes_every_word(call: Callable[..., Any], option: str, word: str) -> None:
    m = call(SQUARE, [(0, 0), (1, 0), (1, 4), (0, 4)], **{option: word})
    assert m(0.0).tolist() == m.source.points.tolist()


@pytest.mark.parametrize(("call", "option", "words"), CALLS)
def test_a_morph_refuses_another_word_and_lists_those_it_takes(
    call: Callable[..., Any], option: str, words: tuple[str, ...]
) -> None:
    with pytest.raises(ValueError, match=option) as caught:
        call(SQUARE, SQUARE, **{option: "spline"})
    assert [word for word in words if word not in str(caught.value)] == []


def test_a_film_takes_every_style_and_both_of_the_extreme_sizes_and_no_more() -> None:
    m = tween.morph(SQUARE, SQUARE)
    for style in choices.STYLES:
        for size in choices.SIZES:
            assert record(m, frames=2, size=size, style=style)
    for size in (choices.SIZES[0] - 1, choices.SIZES[1] + 1):
        with pytest.raises(ValueError, match="size"):
            record(m, frames=2, size=size)
    with pytest.raises(ValueError, match=", ".join(choices.STYLES)):
        record(m, frames=2, style="spline")


def test_the_choices_come_without_waiting_for_any_package() -> None:
    code = "import sys, tween.choices; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "tween.choices" in done.stdout.split()
    assert not {"numpy", "numba", "tween.geometry"} & set(done.stdout.split())
