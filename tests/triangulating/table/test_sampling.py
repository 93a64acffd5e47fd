"""Uniform sampling: counts as doubles that never overflow, and walks that take each triangulation equally often."""

from collections import Counter

import numpy as np
import pytest
from oracle import valid_triangulations
from scipy.stats import chisquare
from strategies import random_polygons

from tween.triangulating.decomposition import decompose
from tween.triangulating.table.splits import Table


def table(points) -> Table:
    return Table(np.asarray(points, dtype=float)[None])


def convex(n):
    t = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(t), np.sin(t)], axis=1)


@pytest.mark.parametrize("n", [3, 4, 10, 40, 400])
def test_counts_of_convex_polygons_are_catalan_numbers_however_large(n):
    counts = table(convex(n))
    mantissas, exponents = counts.weights
    whole = counts.graph.whole
    exact = counts.count
    assert 0.5 <= mantissas[whole] < 1
    # both to 53 bits, the exact number shifted down first where no double could hold it
    shift = max(0, exact.bit_length() - 100)
    assert mantissas[whole] * 2.0 ** (int(exponents[whole]) - shift) == pytest.approx(exact >> shift, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_every_triangulation_is_drawn_equally_often(seed):
    points = next(p for p in random_polygons("disk", 40, seed) if 4 <= len(valid_triangulations(p)) <= 60)
    d = decompose(points)
    every = valid_triangulations(d.curves[0].points)
    drawn = Counter(
        frozenset(frozenset(corners) for corners in T.triangles.tolist())
        for T in d.sample(np.random.default_rng(seed), 200 * len(every))
    )
    assert len(drawn) == len(every)
    assert chisquare(list(drawn.values())).pvalue > 1e-4


def test_the_same_generator_draws_the_same():
    d = decompose(convex(30))
    first, again = (d.sample(np.random.default_rng(3), 5) for _ in range(2))
    assert all((S.triangles == T.triangles).all() for S, T in zip(first, again, strict=True))
