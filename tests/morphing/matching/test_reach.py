"""Which pairs of positions a finer level looks at, beside a plain search of the dual graph."""

import numpy as np
import oracle
import pytest

from tween.gallery import random_disk
from tween.morphing.matching.reach import gap_ranges, near_pairs


def parts(n: int, seed: int):
    T = random_disk(n, np.random.default_rng(seed))
    rng = np.random.default_rng(seed)
    nodes = np.sort(rng.random(n))
    arc = np.sort(np.concatenate([nodes, rng.random(2 * n)]))
    return T, nodes, arc, *gap_ranges(arc, nodes)


@pytest.mark.parametrize("seed", range(4))
def test_a_gap_holds_the_positions_from_its_node_to_the_next(seed: int) -> None:
    _, nodes, arc, low, size = parts(9, seed)
    for r, node in enumerate(nodes):
        length = (nodes[(r + 1) % len(nodes)] - node) % 1.0
        inside = {p for p, a in enumerate(arc) if (a - node + 1e-13) % 1.0 <= length + 1e-12}
        assert {int((low[r] + k) % len(arc)) for k in range(size[r])} == inside


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("steps", [0, 1, 3, 99])
def test_partners_lie_in_gaps_not_too_many_diagonals_away(seed: int, steps: int) -> None:
    T, nodes, arc, low, size = parts(9, seed)
    first, end = near_pairs(np.asarray(arc), np.asarray(nodes), T.points, T.triangles, T.twin.ravel(), steps, 10**6)
    gaps = [{int((low[r] + k) % len(arc)) for k in range(size[r])} for r in range(9)]
    before = [next(t for t, s in np.argwhere(T.twin < 0) if T.triangles[t, s] == r) for r in range(9)]
    for p in range(len(arc)):
        own = [r for r in range(9) if p in gaps[r]]
        far = np.min([oracle.distances(T.triangles, before[r]) for r in own], axis=0)
        wanted = set().union(*(gaps[r] for r in range(9) if far[before[r]] <= steps)) - {p}
        row = end[first[p] : first[p + 1]].tolist()
        assert wanted <= set(row) and len(row) == len(set(row))  # corners of larger triangles may be added
        assert row == sorted(row, key=lambda q, p=p: (q - p) % len(arc))
