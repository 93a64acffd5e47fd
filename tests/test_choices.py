"""Every word that stands in a list of choices is taken, and every other word is refused with the list."""

import subprocess
import sys

import pytest

import tween
from tween import choices
from tween.plot.film import record

SQUARE = [(0, 0), (3, 0), (3, 2), (0, 2)]
OPTIONS = {
    "path": choices.PATHS,
    "root": choices.ROOT_RULES,
    "strategy": choices.STRATEGIES,
    "order": choices.ORDERS,
    "shifts": choices.SHIFT_RULES,
}


@pytest.mark.parametrize(("option", "word"), [(o, w) for o, words in OPTIONS.items() for w in words])
def test_a_morph_takes_every_word(option: str, word: str) -> None:
    m = tween.morph(SQUARE, [(0, 0), (1, 0), (1, 4), (0, 4)], **{option: word})
    assert m(0.0).tolist() == m.source.points.tolist()


@pytest.mark.parametrize("option", OPTIONS)
def test_a_morph_refuses_another_word_and_lists_those_it_takes(option: str) -> None:
    with pytest.raises(ValueError, match=option) as caught:
        tween.morph(SQUARE, SQUARE, **{option: "spline"})
    assert [word for word in OPTIONS[option] if word not in str(caught.value)] == []


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
