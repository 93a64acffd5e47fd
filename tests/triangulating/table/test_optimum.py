"""The best triangulation: against all of them."""

import numpy as np
import pytest
from oracle import valid_triangulations
from strategies import random_polygons

from tween.triangulating.decomposition import decompose


def costs_of(seed):
    """A cost for every triangle, negative ones and ties among them."""

    def cost(triangles):
        mixed = np.sort(triangles, axis=1) @ [7919, 104729, 1299709] * (seed + 1)
        return (mixed % 23 - 5).astype(float)

    return cost


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("kind", ["disk", "strip", "grid"])
def test_no_triangulation_costs_less(kind, combine):
    tried = 0
    for seed, points in enumerate(random_polygons(kind, 40, seed=3)):
        d = decompose(points)
        if not d:
            continue
        cost, together = costs_of(seed), sum if combine == "sum" else max
        every = [[sorted(corners) for corners in T] for T in valid_triangulations(d.curves[0].points)]
        least = min(together(cost(np.array(T)).tolist()) for T in every)
        assert together(cost(d.optimal(cost, combine).triangles).tolist()) == least
        tried += 1
    assert tried >= 5


def test_where_all_cost_infinitely_much_some_triangulation_is_taken():
    d = decompose([[0, 0], [2, -1], [4, 0], [2, 1]])
    T = d.optimal(lambda triangles: np.full(len(triangles), np.inf))
    assert T.validate() is T
