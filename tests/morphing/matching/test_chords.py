"""Chords and splits, beside all triangulations of small curves."""

import numpy as np
import oracle
import pytest

from tween.gallery import random_disk
from tween.morphing.matching.chords import (
    PIECE,
    ROUND,
    STRAIGHT,
    all_pairs,
    find_chords,
    find_splits,
    straight_lines,
)
from tween.morphing.matching.flatness import FLAT
from tween.morphing.matching.shape import Shape


def parts(n: int, seed: int, candidates: int = 0):
    T = random_disk(n, np.random.default_rng(seed))
    shape = Shape(T, np.zeros(n, dtype=bool))
    level = shape.level(n)
    shares = np.arange(1, candidates + 1) / (candidates + 1)
    places = (shape.arc[:, None] + np.diff(np.append(shape.arc, 1.0))[:, None] * shares).ravel()
    positions = shape.positions(level, places)
    return T, positions, find_chords(positions, shape.disk(level), *all_pairs(len(positions.arc)), False)


@pytest.mark.parametrize("seed", range(6))
def test_straight_chords_between_vertices_are_the_diagonals_of_triangulations(seed: int) -> None:
    T, _, chords = parts(8, seed)
    every = oracle.valid_triangulations(T.points)
    edges = {frozenset((t[i], t[i - 1])) for triangles in every for t in triangles for i in range(3)}
    sides = {frozenset((v, (v + 1) % 8)) for v in range(8)}
    pairs = np.stack([chords.start, chords.end], axis=1)
    assert set(map(frozenset, pairs[chords.kind == STRAIGHT].tolist())) == edges - sides
    assert set(map(tuple, pairs[chords.kind == PIECE].tolist())) == {(v, (v + 1) % 8) for v in range(8)}
    assert (chords.kind == ROUND).sum() == 8


@pytest.mark.parametrize("seed", range(3))
def test_splits_are_counter_clockwise_triangles_of_chords(seed: int) -> None:
    _, positions, chords = parts(8, seed, candidates=2)
    splits, first, _ = find_splits(positions, chords, FLAT, True)
    points = oracle.fractions(positions.points)
    for left, right, whole, j in zip(splits.left, splits.right, splits.whole, splits.end, strict=True):
        i, k = chords.start[left], chords.end[left]
        assert chords.start[right] == k and chords.end[right] == j == chords.end[whole] and chords.start[whole] == i
        assert oracle.orient2d(points[i], points[k], points[j]) == 1
    assert first[-1] == len(splits.left)
    assert (splits.cross > 0).all()


def test_edges_that_go_straight_on_are_one_line() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 1.0]])
    lines = straight_lines(points)
    assert lines[0] == lines[1] and lines[4] == lines[5] and len(set(lines.tolist())) == 4
