r"""The search: where to begin, how to go on, and what to try where a level cannot be refined.

An *attempt* says how many vertices the first level has, how dear stretch is and how many of the first level's
local minima are followed.  Cheap attempts come first; the first one that reaches all vertices is the answer.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tween.morphing.matching.levels import Correspondence, Effort, Landmarks, Shape, first_level, next_level

SMALL = 24
"""Vertices up to which two curves are matched in one exact table."""

_GROWTH = 1.35  # of the number of vertices from level to level
_EFFORTS = (Effort(5, 5, 0.3, 0), Effort(8, 8, 0.15, 1), Effort(12, 11, 0.0, 1), Effort(20, 14, 0.0, 2))
_SLACK = 1.5  # a level may cost so many times as much as the one before it, then whatever it may


class Attempt(NamedTuple):
    """One rung of the ladder.

    Attributes
    ----------
    first : int
        Vertices of the first level.
    stretch : float
        Price of stretch at all levels but the last.
    starts : int
        Local minima of the first level that are followed.
    """

    first: int
    stretch: float
    starts: int


_ATTEMPTS = (Attempt(24, 0.0, 3), Attempt(32, 0.0, 3), Attempt(24, 4.0, 3), Attempt(44, 0.0, 2), Attempt(44, 8.0, 2))


@dataclass(frozen=True)
class Found:
    """What the search came to.

    Attributes
    ----------
    disks : (int, int)
        Which of the source's disks, and which of the target's.
    correspondence : Correspondence or None
        Of the last level; None where not even a first level could be matched.
    levels : tuple of (int, int, float)
        Vertices of the source and of the target and the energy, level by level.
    complete : bool
        Whether the last level has all vertices.
    """

    disks: tuple[int, int]
    correspondence: Correspondence | None
    levels: tuple[tuple[int, int, float], ...]
    complete: bool


def sizes_of_levels(n: int, m: int, first: int) -> list[tuple[int, int]]:
    """Numbers of vertices of two curves level by level."""
    sizes, size = [], float(first)
    while True:
        sizes.append((min(n, round(size)), min(m, round(size))))
        if sizes[-1] == (n, m):
            return sizes
        size *= _GROWTH


def even_candidates(n: int, m: int) -> tuple[int, int]:
    """Candidates an edge such that each curve has about twice as many positions as the larger has vertices."""
    most = max(n, m)
    return max(1, -(-2 * most // n) - 1), max(1, -(-2 * most // m) - 1)


def search(sources: list[Shape], targets: list[Shape], nodes: Landmarks) -> Found:
    """Match every disk of the source with every one of the target and return the best that reaches all vertices."""
    best = Found((0, 0), None, (), False)
    for attempt in _ATTEMPTS:
        for found in _starts(sources, targets, nodes, attempt):
            refined = _refine(sources[found.disks[0]], targets[found.disks[1]], nodes, attempt, found)
            if refined.complete:
                return refined
            if best.correspondence is None or sum(refined.levels[-1][:2]) > sum(best.levels[-1][:2]):
                best = refined
    return best


def _starts(sources: list[Shape], targets: list[Shape], nodes: Landmarks, attempt: Attempt) -> list[Found]:
    """Local minima of the first level over all pairs of disks, the best first."""
    starts = []
    for s, S in enumerate(sources):
        for t, T in enumerate(targets):
            sizes = sizes_of_levels(len(S), len(T), attempt.first)[0]
            candidates = even_candidates(*sizes)
            for c in first_level(S, T, sizes, candidates, nodes, attempt.stretch, np.inf):
                starts.append(Found((s, t), c, ((*sizes, c.cost + 4.0),), sizes == (len(S), len(T))))
    return sorted(starts, key=lambda found: found.levels[0][2])[: attempt.starts]


def _refine(S: Shape, T: Shape, nodes: Landmarks, attempt: Attempt, start: Found) -> Found:
    """Go from level to level as far as it goes."""
    sizes = sizes_of_levels(len(S), len(T), attempt.first)
    S.prepare([n for n, _ in sizes])
    T.prepare([m for _, m in sizes])
    last, levels = start.correspondence, list(start.levels)
    for n, m in sizes[1:]:
        finer = _climb(S, T, (n, m), last, nodes, 0.0 if (n, m) == sizes[-1] else attempt.stretch)
        if finer is None:
            return Found(start.disks, last, tuple(levels), False)
        last = finer
        levels.append((n, m, last.cost + 4.0))
    return Found(start.disks, last, tuple(levels), True)


def _climb(
    S: Shape, T: Shape, sizes: tuple[int, int], last: Correspondence, nodes: Landmarks, stretch: float
) -> Correspondence | None:
    """One level, with more and more effort until it can be matched."""
    for effort in _EFFORTS:
        for bound in (_SLACK * last.cost + 1.0, np.inf):
            finer = next_level(S, T, sizes, last, nodes, effort, stretch, bound)
            if finer is not None:
                return finer
    return None
