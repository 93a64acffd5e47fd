"""Clocks: how time is distributed over the pieces of a motion.

A motion has a time of its own: that in which apexes run along their paths, and in which a flow approaches its disk.  At
an even pace the vertices always move equally fast instead, whatever the motion's own time says.

Between two samples of a piece its own time runs evenly.  An interval is halved until both halves are equally long to
a few parts in a hundred, or too short to matter: so a triangle that opens quickly gets the time for it, and in any
span of time the root mean square of the vertices' ways is that share of the whole, not a jump.

Legend: ``share`` of a piece, 0 to 1; ``length`` root mean square of the ways of the vertices.
"""

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

CLOSE, LEAP = 1e-7, 1e-3  # so close to an end or a flip, a vertex that moves by more than that share of the width leaps
_SAMPLES = 33  # of a piece to begin with
_CLOSE_TO_END = 2.0 ** -np.arange(6.0, 36.0)
_ROUNDS = 30  # of halving
_UNEVEN = 0.03  # by which halves may differ, as a share of both
_SHORT = 1e-5  # of the whole; what is shorter is not halved
_MOST_SAMPLES = 2**16  # of a piece; one of which rounding leaves but noise gets longer the closer one looks
_LEAST = 1e-9  # of the whole; the time of a piece that hardly moves
_AT_ONCE = 2**20  # vertices times shapes that are looked at together
_SAME = 1e-12  # of the whole; so close to where pieces meet, the shape is that where they meet


class Clock:
    """The times of the pieces of a motion, 0 to 1 in all.

    Parameters
    ----------
    pieces : list of callable
        From shares, shape (k,), to shapes, shape (k, n, 2).
    spans : ndarray of float64, shape (pieces,), optional
        The time that each piece gets, in which it runs by its own; without it the vertices always move equally fast.
    close : bool
        Whether to look closely at the ends of pieces, where a motion may leap unnoticed between two samples.

    Attributes
    ----------
    starts : list of float
        When each piece begins, and 1.
    """

    def __init__(
        self,
        pieces: list[Callable[[NDArray[np.float64]], NDArray[np.float64]]],
        spans: NDArray[np.float64] | None = None,
        close: bool = False,
    ) -> None:
        if spans is None:
            spans = self._measured(pieces, close)
        else:
            self._shares = self._ways = [np.array([0.0, 1.0])] * len(pieces)
        ends = np.concatenate([[0.0], np.cumsum(spans)]) / spans.sum()
        ends[-1] = 1.0
        self.starts: list[float] = ends.tolist()

    def _measured(
        self, pieces: list[Callable[[NDArray[np.float64]], NDArray[np.float64]]], close: bool
    ) -> NDArray[np.float64]:
        """Measure the pieces, and give each time in proportion to its length."""
        samples = np.linspace(0.0, 1.0, _SAMPLES)
        if close:
            samples = np.unique([*samples, *_CLOSE_TO_END, *(1.0 - _CLOSE_TO_END)])
        first = [_sampled(piece, samples) for piece in pieces]
        whole = sum(length.sum() for _, length in first)
        measured = [_refined(piece, *sample, whole) for piece, sample in zip(pieces, first, strict=True)]
        whole = sum(length.sum() for _, length in measured)
        ways = [np.concatenate([[0.0], np.cumsum(length)]) for _, length in measured]
        self._shares = [share for share, _ in measured]
        self._ways = [way / way[-1] if way[-1] > 0 else share for way, share in zip(ways, self._shares, strict=True)]
        return np.array([max(way[-1], _LEAST * whole) if whole > 0 else 1.0 for way in ways])

    def places(self, t: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Tell in which piece times lie, and where in it.

        Parameters
        ----------
        t : ndarray of float64, shape (k,)

        Returns
        -------
        number : ndarray of int, shape (k,)
        share : ndarray of float64, shape (k,)
            Exactly 1 in the piece before a place where two meet, close to it.
        """
        ends = np.array(self.starts)
        number = np.clip(np.searchsorted(ends, t - _SAME, side="right") - 1, 0, len(ends) - 2)
        share = np.empty(len(t))
        for i in np.unique(number):
            here = number == i
            passed = (t[here] - ends[i]) / (ends[i + 1] - ends[i])
            share[here] = np.interp(passed, self._ways[i], self._shares[i])
        share[t >= ends[number + 1] - _SAME] = 1.0
        share[t == 0.0] = 0.0
        return number, share

    def time(self, number: int, share: float) -> float:
        """Tell when a piece is at a share of it.

        Parameters
        ----------
        number : int
        share : float

        Returns
        -------
        float
        """
        start, stop = self.starts[number : number + 2]
        passed = np.interp(share, self._shares[number], self._ways[number])
        return float(start + passed * (stop - start))


def largest_leap(
    at: Callable[[NDArray[np.float64]], NDArray[np.float64]], marks: Iterable[float]
) -> tuple[float, float]:
    """Find where a motion moves so fast that people see a jump: close to its ends, or to a flip.

    Parameters
    ----------
    at : callable
        From times, shape (k,), to shapes, shape (k, n, 2).
    marks : iterable of float
        Times beside which to look, apart from both ends.

    Returns
    -------
    mark, leap : float
        The mark within 1e-7 of which a vertex moves most, and by which share of the width of both ends together.
    """
    places = np.unique([0.0, *marks, 1.0])
    n = at(places[:1]).shape[1] if len(places) > 2 else 1
    found, moved, ends = 0.0, 0.0, []
    for some in np.array_split(places, min(len(places), 1 + 3 * len(places) * n // _AT_ONCE)):
        times = np.clip(some[:, None] + np.array([-CLOSE, 0.0, CLOSE]), 0.0, 1.0)
        shapes = at(times.ravel()).reshape(len(some), 3, -1, 2)
        ends += [shape for mark, shape in zip(some, shapes[:, 1], strict=True) if mark in (0.0, 1.0)]
        moves = (shapes.max(axis=1) - shapes.min(axis=1)).max(axis=(1, 2))
        if moves.max() > moved:
            found, moved = float(some[moves.argmax()]), float(moves.max())
    return found, moved / float(np.ptp(np.concatenate(ends), axis=0).max())


def _sampled(
    piece: Callable[[NDArray[np.float64]], NDArray[np.float64]], share: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return share, _lengths(piece(share))


def _lengths(shapes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Root mean square of the ways of the vertices from shape to shape."""
    moved: NDArray[np.float64] = np.sqrt((np.diff(shapes, axis=0) ** 2).sum(axis=2).mean(axis=1))
    return moved


def _refined(
    piece: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    share: NDArray[np.float64],
    length: NDArray[np.float64],
    whole: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Shares and the lengths between them, the intervals halved whose halves are unequal."""
    doubtful = length > _SHORT * whole
    for _ in range(_ROUNDS):
        which = np.flatnonzero(doubtful)
        if not len(which) or len(share) + len(which) > _MOST_SAMPLES:
            break
        halves = _halves(piece, share[which], share[which + 1])
        share = np.insert(share, which + 1, 0.5 * (share[which] + share[which + 1]))
        places = which + np.arange(len(which))
        length = np.insert(length, which, 0.0)
        doubtful = np.zeros(len(length), dtype=np.bool_)
        length[places], length[places + 1] = halves.T
        uneven = np.abs(halves[:, 1] - halves[:, 0]) > _UNEVEN * halves.sum(axis=1)
        uneven &= halves.sum(axis=1) > _SHORT * whole
        doubtful[places[uneven]] = doubtful[places[uneven] + 1] = True
    return share, length


def _halves(
    piece: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    start: NDArray[np.float64],
    stop: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Lengths of both halves of intervals, shape (k, 2)."""
    halves = np.empty((len(start), 2))
    block = max(1, _AT_ONCE // (3 * len(piece(start[:1])[0])))
    for i in range(0, len(start), block):
        some = slice(i, i + block)
        three = np.stack([start[some], 0.5 * (start[some] + stop[some]), stop[some]], axis=1)
        shapes = piece(three.ravel()).reshape(len(three), 3, -1, 2)
        halves[some] = np.sqrt((np.diff(shapes, axis=1) ** 2).sum(axis=3).mean(axis=2))
    return halves
