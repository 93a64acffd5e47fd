"""The measurements for the ledger, in the sections that they belong to."""

from itertools import pairwise

import numpy as np
import pytest

from experiments.claims import measure, section_3, section_4, section_5, section_6
from experiments.claims.shared import PARAMETERS
from experiments.subjects import flip_graph, polygon
from tween import compatible_shift, decompose, gallery
from tween.morphing.incompatible.flip_sequence import count_crossings

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64)


@pytest.mark.parametrize("n", range(4, 10))
def test_degrees_tell_triangulations_apart(n: int) -> None:
    found, _ = flip_graph(n)
    assert len({tuple(T.degrees.tolist()) for T in found}) == len(found)
    if n < 8:
        counted = section_4.degree_sequences(str(n))
        assert counted["disagree"] == 0
        assert (counted["mirrored"] > 0) == (n > 5)


@pytest.mark.parametrize("n", [6, 15, 30])
def test_flips_in_order_lead_to_the_target_within_the_crossings(n: int) -> None:
    S, T = decompose(polygon(n)).sample(np.random.default_rng(n), 2)
    found, flips, idle = section_6.inserted_in_order(S, T)
    np.testing.assert_array_equal(found.validate().canonical, T.canonical)
    assert 0 <= idle <= flips <= count_crossings(S, T)
    section_6.inserted_once(S, T).validate()


def test_only_polygons_that_show_the_front_of_a_disk_bound_one() -> None:
    fan, elsewhere = np.array([(0, 1, 2), (0, 2, 3)]), np.array([(0, 1, 2), (0, 1, 3)])
    assert section_3.bounds_disk(SQUARE, fan) and section_3.bounds_disk(SQUARE, elsewhere)
    assert not section_3.bounds_disk(SQUARE[::-1], fan)
    assert not section_3.bounds_disk(SQUARE[[0, 2, 1, 3]], fan)
    assert not section_3.bounds_disk(0 * SQUARE, fan)


def test_what_lies_beyond_both_ends_is_a_factor() -> None:
    above, below = section_5.beyond(np.array([[1.0, 2.0, 4.0], [3.0, 3.0, 1.0], [2.0, 4.0, 2.0]]))
    assert above.tolist() == [1.5, 1.0, 1.0]
    assert below.tolist() == [1.0, 1.0, 2.0]


def test_change_that_all_triangles_share_is_not_local() -> None:
    assert section_4.in_a_tenth(np.outer(np.ones(20), [1.0, 2.0, 1.0])) == pytest.approx(0.1)
    assert section_4.in_a_tenth(np.outer(np.arange(20) == 3, [1.0, 2.0, 1.0])) == 1.0


def test_comparing_one_by_one_finds_the_smallest_shift_within_the_square() -> None:
    drawn = decompose(polygon(9)).sample(np.random.default_rng(0), 40)
    for S, T in [*pairwise(drawn), *((T, T.rolled(4)) for T in drawn)]:
        shift, count = section_4.one_by_one(S.degrees.tolist(), T.degrees.tolist())
        assert shift == compatible_shift(S, T)
        assert 9 <= count <= 81
        assert (shift is not None) == section_4.equal_triangles(S, T)


def test_the_outline_bends_at_the_corners_of_a_square_and_leaves_are_corners_of_one_triangle() -> None:
    along = np.linspace(0, 1, 9)[:-1, None]
    sides = [p + along * (q - p) for p, q in zip(SQUARE, np.roll(SQUARE, -1, axis=0), strict=True)]
    bends = section_6.bending(np.concatenate(sides), 0.05)
    assert bends[::8] == pytest.approx(np.pi / 2)
    assert bends[4::8] == pytest.approx(0)
    T = decompose(polygon(7)).arbitrary()
    for v in section_6.leaf_vertices(T):
        assert (T.triangles == v).sum() == 1


def test_two_flips_that_share_no_triangle_show_that_variance_is_no_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    T = decompose(gallery.curve("horseshoe")).arbitrary()
    assert section_3.not_additive(T)["Var_not_additive"]
    monkeypatch.setattr(section_3, "to_the_disk", lambda S: [float((S.areas**2).sum()), float((1 / S.areas).max())])
    assert section_3.not_additive(T)["AR_not_additive"] is False  # a sum over triangles
    assert section_3.not_additive(T)["Var_not_additive"] is False  # the largest of all


def test_a_morph_whose_ties_are_broken_alike_is_its_reverse() -> None:
    assert section_6.asymmetry("ell - ess") <= 1e-9


def test_a_curve_is_measured_alike_twice_and_as_it_was() -> None:
    first, second = (measure.work("curve: letter c") for _ in range(2))
    assert first == second
    assert first["swaps_valid"] == PARAMETERS["swaps"]
    assert first["flips"] == first["flips_larger"] > 0
    assert first["spines"] == first["spines_longest"] == 1 + PARAMETERS["draws"]
    slide, linear = (measure.work(f"{path}: letter c") for path in ("slide", "linear"))
    assert slide["relative"] == 0 < linear["relative"]


def test_every_kind_of_measurement_has_its_parts() -> None:
    assert {part.split(": ")[0] for part in measure.parts()} == set(measure.WORK)
