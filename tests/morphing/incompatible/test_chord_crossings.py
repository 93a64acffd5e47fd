"""Diagonals that cross a chord, counted in logarithmic time: against looking at each."""

import numpy as np
from hypothesis import given
from strategies import convex_triangulations, disks

from tween.geometry.triangulation import Triangulation
from tween.morphing.incompatible.chord_crossings import chord_crossings, crossings_of_chord, crossings_of_chords


def crossed(T: Triangulation, a: int, b: int) -> int:
    """One end strictly between a and b, the other strictly outside."""
    c, d = min(a, b), max(a, b)
    ends = [sorted(diagonal) for diagonal in T.diagonals.tolist()]
    return sum((c < i < d) != (c < j < d) and c not in (i, j) and d not in (i, j) for i, j in ends)


@given(convex_triangulations(high=14))
def test_of_convex_polygons(T):
    for a in range(len(T)):
        for b in range(len(T)):
            if a != b:
                assert crossings_of_chord(chord_crossings(T), a, b) == crossed(T, a, b)


@given(disks(high=60))
def test_of_immersed_disks_all_chords_at_once(T):
    rng = np.random.default_rng(len(T))
    chords = np.array([rng.choice(len(T), 2, replace=False) for _ in range(50)])
    counts = crossings_of_chords(chord_crossings(T), chords)
    assert counts.tolist() == [crossed(T, a, b) for a, b in chords.tolist()]


def test_diagonals_and_sides_are_crossed_by_none():
    t = np.arange(100) * 2 * np.pi / 100
    T = Triangulation(np.stack([np.cos(t), np.sin(t)], axis=1), [[0, i, i + 1] for i in range(1, 99)])
    ready = chord_crossings(T)
    assert all(crossings_of_chord(ready, 0, i) == 0 for i in range(1, 100))
    assert crossings_of_chord(ready, 10, 60) == 49  # the spokes between them
