r"""The search: where to begin, how to go on, and what to try where a level cannot be refined.

An *attempt* says how many vertices the first level has, how dear stretch is and how many of the first level's
local minima are followed.  Simplified curves tell little of the whole ones: an L looks much the same from end to end.
So several minima are refined side by side, as long as that is cheap, and the best of them goes on.  Cheap attempts come
first; the first one that reaches all vertices is the answer.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import Correspondence, Effort, first_level, next_level
from tween.morphing.matching.pieces import next_level_in_pieces
from tween.morphing.matching.shape import Shape
from tween.morphing.matching.simplify import MANY

SMALL = 24
"""Vertices up to which two curves are matched in one exact table."""

_GROWTH, _FINE_GROWTH = 1.35, 1.5  # of the number of vertices from level to level
_LEAST_GROWTH = 1.1  # a level below the last one needs so many times fewer vertices
_SAME = 1e-9  # energies, and turns, that differ by less are the same
_CHEAP = 130  # vertices up to which rivals are refined
_RISE = 1.25  # of the energy over all levels, above which the simplified curves stood ill for the whole
_MORE = 2  # further attempts that are then made
_MOST_DIVISIONS = 2  # of steps between levels in which nothing was found, in one attempt
_EVEN = (1, 2, 3, 5, 8)  # candidates on every edge of small curves, one after the other until they can be matched
_MOST_POSITIONS = 120  # on each curve, in the exact tables of small curves
_FINE = 160  # vertices from which on images are candidates enough, and the last correspondence is good


class Attempt(NamedTuple):
    """One rung of the ladder.

    Attributes
    ----------
    first : int
        Vertices of the first level.
    even : int
        Evenly spaced candidates on every edge at the first level.
    stretch : float
        Price of stretch at all levels but the last.
    starts : int
        Local minima of the first level that are tried with more candidates.
    efforts : tuple of Effort
        For each further level, until one can be matched.
    sharpness : float
        See `.simplify.simplify`.
    literal : bool
        Whether both curves have exactly so many candidates on every edge.
    rivals : int
        Local minima that are refined side by side.
    """

    first: int
    even: int
    stretch: float
    starts: int
    efforts: tuple[Effort, ...]
    sharpness: float = 0.0
    literal: bool = False
    rivals: int = 1


_AGAIN = Effort(16, 8, 0.0, 2)  # the first level once more, near its own result
_LIGHT = (Effort(7, 3, 0.3, 1, 60), Effort(16, 6, 0.0, 1, 100), Effort(40, 10, 0.0, 2, 200))
_HEAVY = (Effort(24, 8, 0.0, 1, 200), Effort(40, 12, 0.0, 2, 300), Effort(64, 14, 0.0, 3, 400))
_NARROW = (Effort(5, 5, 0.3, 0, 60), Effort(6, 5, 0.0, 0, 60), Effort(10, 7, 0.0, 1, 120))
_IN_PIECES = (
    Effort(4, 3, 0.2, 0, 30),
    Effort(6, 5, 0.0, 0, 60),
    Effort(16, 6, 0.0, 1, 100),
    Effort(40, 10, 0.0, 2, 200),
)
_ATTEMPTS = (
    Attempt(24, 1, 0.0, 4, _LIGHT, rivals=4),
    Attempt(32, 1, 0.0, 4, _LIGHT, rivals=4),
    Attempt(24, 1, 0.0, 4, _LIGHT, 0.05, rivals=4),
    Attempt(32, 1, 0.0, 4, _HEAVY, 0.02),
    Attempt(24, 2, 0.0, 4, _HEAVY),
    Attempt(24, 1, 4.0, 4, _HEAVY),
    Attempt(44, 1, 0.0, 2, _HEAVY),
    Attempt(32, 2, 4.0, 2, _HEAVY, 0.1),
)


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
    stuck : bool
        Whether the next level could not be matched.
    """

    disks: tuple[int, int]
    correspondence: Correspondence | None
    levels: tuple[tuple[int, int, float], ...]
    complete: bool
    stuck: bool = False


def sizes_of_levels(n: int, m: int, first: int) -> list[tuple[int, int]]:
    """Numbers of vertices of two curves level by level.

    Parameters
    ----------
    n, m : int
        Vertices of the two curves.
    first : int
        Vertices of the first level, at most.

    Returns
    -------
    list of (int, int)
        The coarsest first; the last is (n, m).
    """
    sizes, size = [], float(first)
    while size * _LEAST_GROWTH < max(n, m):
        sizes.append((min(n, round(size)), min(m, round(size))))
        size *= _GROWTH if size < _FINE else _FINE_GROWTH
    return [*sizes, (n, m)]


def even_candidates(n: int, m: int, even: int = 1) -> tuple[int, int]:
    """Candidates an edge, so many or as many as give each curve twice the positions that the larger has vertices.

    Parameters
    ----------
    n, m : int
        Vertices of the two curves.
    even : int
        Candidates an edge, at least.

    Returns
    -------
    (int, int)
    """
    most = (even + 1) * max(n, m)
    return max(even, -(-most // n) - 1), max(even, -(-most // m) - 1)


def search(sources: list[Shape], targets: list[Shape], nodes: Landmarks, candidates: int | None) -> Found:
    """Match every disk of the source with every one of the target and return the best that reaches all vertices.

    Parameters
    ----------
    sources, targets : list of Shape
        The disks that each curve bounds.
    nodes : Landmarks
    candidates : int or None
        See `tween.match.match`.

    Returns
    -------
    Found
        The first one that is complete; where none is, the one that came farthest.
    """
    best, more = Found((0, 0), None, (), False), _MORE
    for attempt in _attempts(len(sources[0]), len(targets[0]), candidates):
        if best.complete and (more == 0 or best.levels[-1][2] <= _RISE * best.levels[0][2]):
            break
        more -= best.complete
        found = _try(sources, targets, nodes, attempt)
        if found is not None and _rank(found) > _rank(best):
            best = found
    return best


def _try(sources: list[Shape], targets: list[Shape], nodes: Landmarks, attempt: Attempt) -> Found | None:
    """The first start that reaches all vertices, or else the one that comes farthest."""
    S, T = ([shape.sharper(attempt.sharpness) for shape in shapes] for shapes in (sources, targets))
    best: Found | None = None
    for start in _race(S, T, nodes, attempt, _starts(S, T, nodes, attempt)):
        found = start if start.stuck else _refine(S[start.disks[0]], T[start.disks[1]], nodes, attempt, start)
        if found.complete:
            return found
        if best is None or _rank(found) > _rank(best):
            best = found
    return best


def _race(S: list[Shape], T: list[Shape], nodes: Landmarks, attempt: Attempt, starts: list[Found]) -> list[Found]:
    """Refine the first starts, the rivals, as far as that is cheap, and put them in order; the others stay behind."""
    if attempt.rivals == 1:
        return starts
    rivals = [
        _refine(S[start.disks[0]], T[start.disks[1]], nodes, attempt, start, _CHEAP)
        for start in starts[: attempt.rivals]
    ]
    return sorted(rivals, key=_rank, reverse=True) + starts[attempt.rivals :]


def _rank(found: Found) -> tuple[bool, int, int, int]:
    """Complete before incomplete; of those by energy, of these by the vertices that they reach.

    Equal energies are a symmetric shape's: then by how little the shape turns, so that it stays on itself.
    """
    if not found.levels:
        return False, 0, 0, 0
    reached = 0 if found.complete else sum(found.levels[-1][:2])
    return found.complete, reached, -_energy(found), -_turn(found)


def _attempts(n: int, m: int, candidates: int | None) -> list[Attempt]:
    """The ladder: of small curves exact tables first, with more and more candidates, then simplified ones."""
    most = max(n, m)
    if most > MANY:
        return [attempt._replace(starts=2) for attempt in _ATTEMPTS[:2]]
    if most > SMALL:
        return [attempt for attempt in _ATTEMPTS if attempt.first < most or attempt.first == SMALL]
    if candidates is not None:
        return [Attempt(SMALL, candidates, 0.0, 1, (), literal=True)]
    exact = [Attempt(SMALL, even, 0.0, 1, ()) for even in _EVEN if (even + 1) * most <= _MOST_POSITIONS or even == 1]
    return exact + [Attempt(first, 2, 0.0, 2, _HEAVY) for first in (most // 2, most // 3) if first > 3]


def _starts(sources: list[Shape], targets: list[Shape], nodes: Landmarks, attempt: Attempt) -> list[Found]:
    """Local minima of the first level over all pairs of disks, the best first."""
    starts = []
    for s, S in enumerate(sources):
        for t, T in enumerate(targets):
            sizes = sizes_of_levels(len(S), len(T), attempt.first)[0]
            candidates = (attempt.even,) * 2 if attempt.literal else even_candidates(*sizes, attempt.even)
            for c in first_level(S, T, sizes, candidates, nodes, attempt.stretch):
                starts.append(Found((s, t), c, ((*sizes, c.cost + 4.0),), sizes == (len(S), len(T))))
    starts.sort(key=_energy)
    if not starts or starts[0].complete:
        return sorted(starts, key=_rank, reverse=True)[:1]
    again = []
    for found in starts[: attempt.starts]:
        S, T, sizes = sources[found.disks[0]], targets[found.disks[1]], found.levels[0][:2]
        assert found.correspondence is not None  # the first level has made one
        better = next_level(S, T, sizes, found.correspondence, nodes, _AGAIN, attempt.stretch)
        if better is not None:
            again.append(Found(found.disks, better, ((*sizes, better.cost + 4.0),), False))
    return sorted(again, key=_energy) + starts[:1]


def _energy(found: Found) -> int:
    """The energy of the last level, rounded: equal ones are equal."""
    return round(found.levels[-1][2] / _SAME)


def _turn(found: Found) -> int:
    """By how much the correspondence turns the source, rounded."""
    c = found.correspondence
    assert c is not None  # a level has made one
    z, w = ((points - points.mean(axis=0)) @ np.array([1.0, 1.0j]) for points in (c.source_points, c.target_points))
    z, w = z / np.abs(z).max(), w / np.abs(w).max()
    return round(abs(float(np.angle(np.vdot(z, w)))) / _SAME)


def _refine(S: Shape, T: Shape, nodes: Landmarks, attempt: Attempt, start: Found, most: int | None = None) -> Found:
    """Go on from level to level as far as it goes, or to the last one of so many vertices."""
    sizes = sizes_of_levels(len(S), len(T), attempt.first)
    S.prepare([n for n, _ in sizes])
    T.prepare([m for _, m in sizes])
    last, levels, divided = start.correspondence, list(start.levels), 0
    assert last is not None  # the first level has made one
    ahead = [size for size in reversed(sizes) if max(size) > max(levels[-1][:2])]
    while ahead and (most is None or max(ahead[-1]) <= most):
        n, m = ahead.pop()
        finer = _climb(S, T, (n, m), last, nodes, attempt, 0.0 if (n, m) == sizes[-1] else attempt.stretch)
        if finer is not None:
            last = finer
            levels.append((n, m, last.cost + 4.0))
            continue
        between = _between(levels[-1][:2], (n, m))
        if between is None or divided == _MOST_DIVISIONS:
            return Found(start.disks, last, tuple(levels), False, True)
        ahead += [(n, m), between]
        divided += 1
    return Found(start.disks, last, tuple(levels), not ahead)


def _between(coarse: tuple[int, int], fine: tuple[int, int]) -> tuple[int, int] | None:
    """Numbers of vertices half-way between two levels."""
    middle = ((coarse[0] + fine[0]) // 2, (coarse[1] + fine[1]) // 2)
    return None if middle == coarse else middle


def _climb(
    S: Shape,
    T: Shape,
    sizes: tuple[int, int],
    last: Correspondence,
    nodes: Landmarks,
    attempt: Attempt,
    stretch: float,
) -> Correspondence | None:
    """One level, with more and more effort until it can be matched."""
    if max(sizes) > _FINE and max(len(S), len(T)) > MANY:
        return next_level_in_pieces(S, T, sizes, last, nodes, _IN_PIECES)
    for effort in attempt.efforts if max(sizes) <= _FINE else _NARROW:
        finer = next_level(S, T, sizes, last, nodes, effort, stretch)
        if finer is not None:
            return finer
    return None
