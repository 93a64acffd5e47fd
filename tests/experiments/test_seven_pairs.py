"""The rows of Figure 11: when a curve crosses itself, how round it is, and what is told of a row."""

import numpy as np
import pytest

from experiments.seven_pairs import PAPER, Row, common_shift, in_words, roundness, row, spells, table
from tween import Morph, gallery, triangulate
from tween.gallery import curve


@pytest.fixture(scope="module")
def compatible() -> Row:
    return row("horseshoe_to_loop")


@pytest.fixture(scope="module")
def flipped() -> Row:
    return row("arrow_to_horseshoe")


def straight(source: np.ndarray, target: np.ndarray) -> Morph:
    """Return something that moves like a morph, along straight lines."""

    class Straight:
        def at(self, times: np.ndarray) -> np.ndarray:
            return source + np.asarray(times)[:, None, None] * (target - source)

    return Straight()  # type: ignore[return-value]


def test_spells_begin_and_end_where_crossings_do() -> None:
    bow = np.array([(0, 0), (2, 0), (0, 2), (2, 2)], dtype=float)
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 3)], dtype=float)
    ((start, end),) = spells(straight(bow, square), count=21)
    assert start == 0
    assert end == pytest.approx(0.40)  # vertex 2 leaves the other side at sqrt(6) - 2, that is 0.449
    assert spells(straight(square, 2 * square), count=5) == []


def test_a_morph_may_cross_itself_at_first_and_again_at_last(compatible: Row) -> None:
    first, last = spells(compatible.morph)
    assert first[0] == 0
    assert last[1] == 1
    assert first[1] < last[0]


def test_a_circle_is_round_and_a_square_less() -> None:
    assert roundness(triangulate(curve("convex")).on_disk("uniform").points) == pytest.approx(1, abs=0.01)
    assert roundness(np.array([(0, 0), (1, 0), (1, 1), (0, 1)])) == pytest.approx(np.pi / 4)


def test_a_common_triangulation_is_found_where_there_is_one() -> None:
    assert common_shift(*gallery.pair("horseshoe_to_loop")) == 0
    assert common_shift(*gallery.pair("arrow_to_horseshoe")) is None


def test_a_row_is_told_with_its_flips_only_where_it_has_any(compatible: Row, flipped: Row) -> None:
    assert "flips" not in in_words(compatible)
    told = in_words(flipped)
    assert f"{len(flipped.morph.events)} flips; u = {flipped.morph.u:.3f}" in told
    assert "(47 inserted on the source)" in told
    assert "common triangulation: none" in told
    assert "certified: True" in told


def test_the_table_has_a_line_for_each_row_beside_the_papers(
    compatible: Row, flipped: Row, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("experiments.seven_pairs.PAPER", (PAPER[1], PAPER[5]))
    found = table({"horseshoe_to_loop": compatible, "arrow_to_horseshoe": flipped})
    assert found.paper.tolist() == ["compatible", "incompatible; pivots marked"]
    assert found.flips.tolist() == [0, 96]
    assert found["last flip"].tolist()[0] == ""
    assert found["last flip"].tolist()[1] == f"{flipped.morph.events[-1].time:.3f}"
    assert found["of target"].tolist()[1] == f"{roundness(flipped.morph(1)):.2f}"
    assert found.ours.tolist() == ["compatible", "incompatible; pivots matched"]
