"""The ladder of levels and candidates."""

import numpy as np
import pytest

from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.search import SMALL, even_candidates, search, sizes_of_levels
from tween.morphing.matching.simplify import Shape


@pytest.mark.parametrize(("n", "m"), [(24, 24), (25, 100), (100, 31), (500, 3)])
def test_levels_grow_to_all_vertices_of_both(n: int, m: int) -> None:
    sizes = np.array(sizes_of_levels(n, m, SMALL))
    assert tuple(sizes[-1]) == (n, m)
    assert (np.diff(sizes, axis=0) >= 0).all() and (np.diff(sizes, axis=0).max(axis=1) > 0).all()
    assert (sizes[0] <= SMALL).all()


@pytest.mark.parametrize(("n", "m"), [(4, 4), (4, 20), (20, 4), (7, 24)])
def test_the_curve_of_fewer_vertices_has_more_candidates(n: int, m: int) -> None:
    positions = [(c + 1) * k for c, k in zip(even_candidates(n, m), (n, m), strict=True)]
    assert min(positions) >= 2 * max(n, m)
    assert max(positions) < min(positions) + 2 * max(n, m)


def shape(n: int, seed: int) -> Shape:
    return Shape(random_disk(n, np.random.default_rng(seed)), np.zeros(n, dtype=bool))


NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def test_of_several_disks_the_one_that_matches_best_is_found() -> None:
    one, other = shape(8, 0), shape(8, 1)
    found = search([one, other], [other], NO_LANDMARKS, None)
    assert found.complete and found.disks == (1, 0)
    assert found.levels[-1] == (8, 8, pytest.approx(4.0))
