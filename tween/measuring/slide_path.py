r"""Where third vertices are on the path "slide", enclosed: disks about where they are halfway through an interval.

The path runs along the segment from z1 to z2, but around a disk about an end of the base, 0 or 1, wherever the segment
cuts through it and the edge to that end is the base of another triangle; the radius of the disk is the distance of the
nearer one of z1 and z2.  Where the segment cuts through both disks the path runs around both together.

It is run at constant speed.  So within half an interval of h a third vertex comes no farther than h / 2 times the
length of the path.  The points halfway are computed in doubles, and the disks widened by 1e-7 of their distances to
both ends of the base: far more than some fifty roundings are off, and the root of a difference where circles touch.

Legend: ``end`` 0 or 1, None for a segment; ``s`` share of the segment.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.measuring.intervals import Interval

_WIDER = 1e-7

_Piece = tuple[complex, complex, int | None]
_Floats = NDArray[np.float64]


def enclosed_slide(plan: Any, p: _Floats, q: _Floats) -> tuple[NDArray[np.int64], Interval, Interval]:
    """Enclose the third vertices that slide.

    Parameters
    ----------
    plan : Plan
    p, q : ndarray of float64, shape (k,)
        Where intervals of the leg's time begin and end.

    Returns
    -------
    rows : ndarray of int64, shape (r,)
        Of the triangles whose third vertices do not run along a segment all the way.
    x, y : Interval
        Of these, shape (r, k).
    """
    corners, rows, found = np.asarray(plan.corners), [], []
    bases = {(int(a), int(b)) for a, b in corners[1:, :2]}
    z1, z2 = (_thirds(points, corners) for points in (plan.source, plan.target))
    for i, (a, b, c) in enumerate(corners.tolist()):
        ends = [end for end, base in ((0, (a, c)), (1, (c, b))) if base in bases]
        pieces = outline(complex(z1[i]), complex(z2[i]), ends)
        if any(end is not None for _, _, end in pieces):
            rows.append(i)
            found.append(_disks(pieces, p, q))
    places = np.array(found).reshape(-1, 4, len(p))
    x, y = Interval(places[:, 0], places[:, 1]), Interval(places[:, 2], places[:, 3])
    return np.array(rows, dtype=np.int64), x, y


def outline(z1: complex, z2: complex, ends: list[int]) -> list[_Piece]:
    """The pieces of a path.

    Parameters
    ----------
    z1, z2 : complex
        Third vertices over the base from 0 to 1, in the upper half plane.
    ends : list of int
        Ends of the base, 0 and 1, the edge to which is the base of another triangle.

    Returns
    -------
    list of (complex, complex, int or None)
        From where, to where, and around which end of the base.

    Examples
    --------
    >>> outline(-1 + 1j, 1 + 1j, [0])
    [((-1+1j), (1+1j), 0)]
    """
    chords = {end: chord for end in ends if (chord := _chord(z1, z2, end))}
    order = sorted(chords, key=lambda end: chords[end][0])
    if len(order) == 2:
        (first, last) = (chords[end] for end in order)
        if last[1] <= first[1]:
            order = order[:1]
        elif last[0] == first[0]:
            order = order[1:]
    places = [z1 + s * (z2 - z1) for end in order for s in chords[end]]
    if len(order) == 2 and chords[order[1]][0] < chords[order[0]][1]:  # from one circle to the other where they meet
        places[1] = places[2] = _meeting(abs(places[0] - order[0]), abs(places[3] - order[1]), order[0])
    pieces: list[_Piece] = []
    here = z1
    for end, entry, leave in zip(order, places[::2], places[1::2], strict=True):
        pieces += [(here, entry, None)] if entry != here else []
        pieces.append((entry, leave, end))
        here = leave
    return [*pieces, (here, z2, None)] if here != z2 or not pieces else pieces


def _chord(z1: complex, z2: complex, end: int) -> tuple[float, float] | None:
    """Between which shares the segment is nearer to an end of the base than both z1 and z2 are; None for nowhere."""
    step = z2 - z1
    foot = ((end - z1) * step.conjugate()).real / abs(step) ** 2 if step else 0.0
    if not 0.0 < foot < 1.0:
        return None
    near_first = abs(z1 - end) <= abs(z2 - end)
    return (0.0, min(1.0, 2.0 * foot)) if near_first else (max(0.0, 2.0 * foot - 1.0), 1.0)


def _meeting(first: float, last: float, end: int) -> complex:
    """Where the circle about one end of the base meets that about the other, above it."""
    about_zero, about_one = (first, last) if end == 0 else (last, first)
    x = 0.5 * (1.0 + (about_zero - about_one) * (about_zero + about_one))
    return complex(x, max(0.0, (about_zero - x) * (about_zero + x)) ** 0.5)


def _disks(pieces: list[_Piece], p: _Floats, q: _Floats) -> list[_Floats]:
    """Bounds of x and of y over intervals of time."""
    lengths = np.array([_length(*piece) for piece in pieces])
    stops = np.concatenate([[0.0], np.cumsum(lengths)])
    way = 0.5 * (p + q) * stops[-1]
    number = np.clip(np.searchsorted(stops, way, side="right") - 1, 0, len(pieces) - 1)
    share = np.clip((way - stops[number]) / np.where(lengths[number] > 0, lengths[number], 1.0), 0.0, 1.0)
    z = np.empty(len(p), np.complex128)
    for i, piece in enumerate(pieces):
        here = number == i
        z[here] = _along(*piece, share[here])
    radius = 0.5 * (q - p) * stops[-1] * (1.0 + _WIDER) + _WIDER * (np.abs(z) + np.abs(1.0 - z))
    return [z.real - radius, z.real + radius, z.imag - radius, z.imag + radius]


def _turns(a: complex, b: complex, end: int) -> tuple[float, float]:
    start, stop = (float(np.angle(z - end)) for z in (a, b))
    return start, stop


def _length(a: complex, b: complex, end: int | None) -> float:
    if end is None:
        return abs(b - a)
    start, stop = _turns(a, b, end)
    return abs(a - end) * abs(stop - start)


def _along(a: complex, b: complex, end: int | None, share: _Floats) -> NDArray[np.complex128]:
    if end is None:
        return np.asarray((1.0 - share) * a + share * b)
    start, stop = _turns(a, b, end)
    return np.asarray(end + abs(a - end) * np.exp(1j * (start + share * (stop - start))))


def _thirds(points: _Floats, corners: NDArray[np.int64]) -> NDArray[np.complex128]:
    a, b, c = (points[corners[:, s]] @ np.array([1.0, 1.0j]) for s in range(3))
    return np.asarray((c - a) / (b - a))
