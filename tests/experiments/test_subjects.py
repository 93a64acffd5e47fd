"""What the studies morph: curves by their names, pairs of them, and all triangulations of a polygon."""

from math import comb

import pytest

from experiments import subjects
from tween import gallery


def test_every_name_is_a_curve_and_every_pair_is_two() -> None:
    names = list(subjects.shapes())
    assert len(subjects.pairs()) == comb(len(names), 2)
    assert len(names) == len(gallery.names()) + len(gallery.letters())
    for found, expected in (
        (subjects.both("ell - letter e"), (gallery.curve("ell"), gallery.letter("e"))),
        (subjects.both("e_to_l"), gallery.pair("e_to_l")),
    ):
        assert all((one.points == other.points).all() for one, other in zip(found, expected, strict=True))


@pytest.mark.parametrize("n", range(4, 9))
def test_the_flip_graph_has_all_triangulations_and_all_flips(n: int) -> None:
    found, neighbours = subjects.flip_graph(n)
    assert len(found) == comb(2 * n - 4, n - 2) // (n - 1)
    assert {len(near) for near in neighbours} == {n - 3}
    assert all(i in neighbours[j] for i, near in enumerate(neighbours) for j in near)
