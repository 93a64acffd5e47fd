"""Edges that meet: the tree of slabs and the plain comparison, against exact arithmetic on all pairs."""

import numpy as np
import oracle
import pytest

from tween.geometry import meeting_edges as module
from tween.geometry.meeting_edges import meeting_edges

SHAPES = ("lattice", "generic", "one column", "long edges", "slivers")


def polygon(kind: str, n: int, seed: int) -> np.ndarray:
    """Without edges of zero length; lattices make touching, collinear and overlapping edges."""
    rng = np.random.default_rng(seed)
    if kind == "lattice":
        points = rng.integers(0, 6, (n, 2)).astype(float)
    elif kind == "one column":
        points = np.stack([rng.integers(0, 2, n), rng.integers(0, 40, n)], axis=1).astype(float)
    elif kind == "long edges":
        points = np.stack([np.arange(n) % 2 * 1e6, rng.normal(size=n)], axis=1)
    elif kind == "slivers":
        points = np.cumsum(rng.integers(-2, 3, (n, 2)), axis=0) * 0.1
    else:
        points = rng.normal(size=(n, 2))
    return points[(points != np.roll(points, -1, axis=0)).any(axis=1)]


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("small", [0, 200], ids=["tree", "plain"])
def test_pairs_are_those_of_exact_arithmetic(kind: str, small: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_SMALL", small)
    for seed in range(12):
        points = polygon(kind, 4 + 5 * seed, seed)
        if len(points) < 3 or (points == np.roll(points, -1, axis=0)).all(axis=1).any():
            continue
        pairs, proper = meeting_edges(points)
        found = dict(zip(map(tuple, pairs.tolist()), proper.tolist(), strict=True))
        assert found == oracle.crossings(points)
        assert pairs.tolist() == sorted(pairs.tolist())


@pytest.mark.parametrize("kind", SHAPES)
def test_the_tree_and_the_plain_comparison_agree_on_many_edges(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points = polygon(kind, 400, 5)
    tree = meeting_edges(points)
    monkeypatch.setattr(module, "_SMALL", len(points))
    plain = meeting_edges(points)
    assert len(points) > 200
    assert np.array_equal(tree[0], plain[0]) and np.array_equal(tree[1], plain[1])
