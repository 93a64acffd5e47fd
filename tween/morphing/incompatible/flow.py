"""Motion between incompatible triangulations by gradual edge flips (Section 6.2).

A `Flow` moves one shape towards its disk and flips, one by one, to the other's triangulation: each flip as soon as its
quadrilateral is convex in the moving shape *with room to spare*: both corners that the new diagonal leaves behind turn
left by 0.02 radians, or by half of what they do on the disk where that is less.  A flip of a quadrilateral that is
hardly convex makes a triangle that is hardly one; the tip of it would leap, and its height would be of the size of
roundings.

Legend: ``tau`` times of a flow, 0 the shape, 1 its disk; ``quad`` corners a, b, c, d around a diagonal
ab that gives way to cd, as in `tween.flips`.
"""

import heapq
from collections import deque
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.choices import Order, Path
from tween.geometry.predicates import turn
from tween.geometry.triangulation import Triangulation
from tween.morphing.compatible.guarantee.angle_budgets import RESERVE
from tween.morphing.compatible.leg import Leg, left_below_full_turn, root_triangle
from tween.morphing.incompatible.flip_sequence import FlipSequence
from tween.triangulating.flips import flip_in_place, quadrilateral

_SCAN = 1 / 512  # step of the search for the first convex time; a shorter spell of convexity may be missed
_CHUNK = 16  # steps looked at together
_SIXTEENTHS = np.arange(1, 17) / 16
_REFINEMENTS = 5  # each divides the step by 16: times are found to 2e-9
_ROOM = 0.02  # radians by which the corners that a flip makes turn at least, unless the disk has too little
_Around = tuple[int, NDArray[np.int64], NDArray[np.float64]]  # of a flip, see `Flow._around`


class Event(NamedTuple):
    """A flip during a motion.

    Attributes
    ----------
    time : float
        When, from 0 to 1.
    out, into : (int, int)
        Ends of the diagonal that gives way, and of the one that comes, the smaller first.
    """

    time: float
    out: tuple[int, int]
    into: tuple[int, int]


class Piece(NamedTuple):
    """Part of a motion.

    Attributes
    ----------
    leg : Leg
    start, stop : float
        The times of the leg between which it runs; backwards where start > stop.
    """

    leg: Leg
    start: float
    stop: float

    def at(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shapes at shares of the piece.

        Parameters
        ----------
        share : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
        """
        return self.leg.at(self.start + share * (self.stop - self.start))

    def reversed(self) -> "Piece":
        """Run the same part backwards.

        Returns
        -------
        Piece
        """
        return Piece(self.leg, self.stop, self.start)


class Flow:
    """A shape on its way to its disk, flipping to another triangulation as it goes.

    Parameters
    ----------
    T : Triangulation
    flips : FlipSequence
        From T to the other triangulation.
    path : str
    root : "disk-center", "tree-center" or int
    order : {"partial", "sequential"}
        "sequential" waits for each flip in turn, as the paper does.  "partial" lets a flip go ahead as
        soon as it is possible and the flips before it that touch the same triangles are done.
    guarantee : bool
        Whether angle budgets keep every shape on the way the boundary of an immersed disk.

    Attributes
    ----------
    end : float
        When the last flip is done: u, or v, of the paper.
    events : list of Event
        The flips, in the order in which they happen, with their times.
    pieces : list of Piece
        The motion from 0 to `end`, one piece between flips.
    start, final : Triangulation
        The shape at 0, and that at `end` under the other triangulation.

    Notes
    -----
    Before each flip the motion is scanned in steps of 1/512 for the first time at which a waiting flip is
    possible, exactly; that time is refined to 2e-9; a spell
    of convexity shorter than a step may be missed.  After a flip the shape goes on from where it is to
    the same disk, under the new triangles, so there is no jump.  At the disk every flip is possible.

    References
    ----------
    Mukherjee and Gopi, Section 6.2 and Figure 10.
    """

    def __init__(
        self,
        T: Triangulation,
        flips: FlipSequence,
        path: Path,
        root: str | int,
        order: Order,
        guarantee: bool = False,
    ) -> None:
        self._flips, self._path, self._root, self._guarantee = flips, path, root, guarantee
        self._rows = flips.rows.tolist()
        self._changes = [
            tuple(map(tuple, change)) for change in zip(flips.out.tolist(), flips.into.tolist(), strict=True)
        ]
        self.start, self._disk = T, T.on_disk().points
        self._left = left_below_full_turn(T), left_below_full_turn(T.moved(self._disk))
        self._stages: list[int] = []
        self._known: dict[int, _Around] = {}
        self._waiting = _Waiting(flips, sequential=order == "sequential")
        self.events: list[Event] = []
        self.pieces: list[Piece] = []
        self.end = 0.0
        self.final = self._flip_all_possible(T)
        while self._waiting:
            self._move_on()

    def events_by_stage(self) -> list[tuple[Event, int]]:
        """List the flips, each with the number of pieces that lie before it.

        Returns
        -------
        list of (Event, int)
        """
        return list(zip(self.events, self._stages, strict=True))

    def reserve(self, tau: float) -> NDArray[np.float64]:
        """What no vertex ever spends of what it has left below 2 pi, however many flips there are.

        Parameters
        ----------
        tau : float

        Returns
        -------
        ndarray of float64, shape (n,)
        """
        return RESERVE * ((1.0 - tau) * self._left[0] + tau * self._left[1])

    def times(self) -> NDArray[np.float64]:
        """The flow's own time, at which each piece begins, and that at which the last one ends.

        Returns
        -------
        ndarray of float64, shape (pieces + 1,)
            From 0 to `end`.
        """
        left = np.cumprod([1.0, *(1.0 - piece.stop for piece in self.pieces)])
        return np.asarray(1.0 - left)

    def _move_on(self) -> None:
        """Run to the first time at which a waiting flip is possible, and flip."""
        root, reserve = root_triangle(self._root, self.final), np.stack([self.reserve(self.end), self.reserve(1.0)])
        leg = Leg(self.final, self._disk, self._path, root, self._guarantee, reserve)
        share, points = self._first_possible(leg)
        if share > 0:
            self.pieces.append(Piece(leg, 0.0, share))
        self.end = 1.0 if share == 1 else self.end + share * (1 - self.end)
        self.final = self._flip_all_possible(self.final.moved(points))

    def _flip_all_possible(self, T: Triangulation) -> Triangulation:
        """Flip, and flip what that makes possible, until nothing more is possible in this shape."""
        triangles, twin, points = T.triangles.copy(), T.twin.copy(), T.points[None]
        candidates = self._waiting.ready()
        while candidates:
            flip = heapq.heappop(candidates)
            h, quad, room = self._around(flip, triangles, twin)
            if first_convex(points, quad, room) == 0:
                flip_in_place(triangles, twin, h)
                self.events.append(Event(self.end, *self._changes[flip]))
                self._stages.append(len(self.pieces))
                for freed in self._waiting.done(flip):
                    heapq.heappush(candidates, freed)
        return Triangulation(T.points, triangles)._knowing(twin)

    def _around(self, flip: int, triangles: NDArray[np.int64], twin: NDArray[np.int64]) -> _Around:
        """The half-edge of a flip that is ready, the corners around it, (1, 4), and their rooms.

        They stay while it waits: flips that change its triangles come before it or after it.
        """
        if flip not in self._known:
            h = shared_edge(twin, *self._rows[flip])
            quad = np.array([quadrilateral(triangles, twin, h)])
            self._known[flip] = h, quad, self._rooms(quad)
        return self._known[flip]

    def _first_possible(self, leg: Leg) -> tuple[float, NDArray[np.float64]]:
        """The first share of the leg at which a waiting flip is possible, and the shape there."""
        known = [self._known[flip] for flip in self._waiting.ready()]
        quads, rooms = (np.concatenate(arrays) for arrays in list(zip(*known, strict=True))[1:])
        step = min(1.0, _SCAN / (1 - self.end))
        low, first = 0.0, -1
        while first < 0 and low < 1:
            shares = np.minimum(1.0, low + step * np.arange(1, _CHUNK + 1))
            shapes = leg.at(shares)
            first = first_convex(shapes, quads, rooms)
            if first < 0:
                low = shares[-1]
        for _ in range(_REFINEMENTS):
            low, high = (shares[first - 1] if first else low), shares[first]
            shares = low + (high - low) * _SIXTEENTHS
            shares[-1] = high
            shapes = leg.at(shares)
            first = first_convex(shapes, quads, rooms)
        return float(shares[first]), shapes[first]

    def _rooms(self, quads: NDArray[np.int64]) -> NDArray[np.float64]:
        """Tangents of the least turns at a and b, (q, 2); on the disk there is twice that room."""
        return np.tan(np.minimum(_ROOM, 0.5 * _turns(self._disk, quads)))


class _Waiting:
    """The flips still to do; a flip is ready when no earlier one waits for either of its two triangles."""

    def __init__(self, flips: FlipSequence, sequential: bool) -> None:
        self._rows: list[list[int]] = (np.zeros_like(flips.rows) if sequential else flips.rows).tolist()
        self._queues: dict[int, deque[int]] = {}
        for flip, rows in enumerate(self._rows):
            for row in set(rows):
                self._queues.setdefault(row, deque()).append(flip)
        self._ready = {flip for flip in {queue[0] for queue in self._queues.values()} if self._is_ready(flip)}

    def __bool__(self) -> bool:
        return bool(self._ready)

    def ready(self) -> list[int]:
        """The flips that are ready, in order."""
        return sorted(self._ready)

    def done(self, flip: int) -> list[int]:
        """Strike a flip off, and return those that it made ready."""
        rows = set(self._rows[flip])
        for row in rows:
            self._queues[row].popleft()
        self._ready.remove(flip)
        freed = [f for f in {self._queues[row][0] for row in rows if self._queues[row]} if self._is_ready(f)]
        self._ready.update(freed)
        return freed

    def _is_ready(self, flip: int) -> bool:
        return all(self._queues[row][0] == flip for row in self._rows[flip])


@njit(cache=True)
def first_convex(shapes, quads, rooms):
    """The first of the shapes, (k, n, 2), in which one of the quads, (q, 4), is convex with room; -1 for none."""
    for f in range(len(shapes)):
        p = shapes[f]
        for q in range(len(quads)):
            a, b, c, d = quads[q]
            if turn(p, d, b, c) > 0 and turn(p, c, a, d) > 0:
                if _has_room(p[c], p[a], p[d], rooms[q, 0]) and _has_room(p[d], p[b], p[c], rooms[q, 1]):
                    return f
    return -1


@njit(cache=True)
def _cross_and_dot(before, here, after):
    ux, uy, vx, vy = here[0] - before[0], here[1] - before[1], after[0] - here[0], after[1] - here[1]
    return ux * vy - uy * vx, ux * vx + uy * vy


@njit(cache=True)
def _has_room(before, here, after, tangent):
    """Whether a way of three points turns left by more than an angle of this tangent."""
    cross, dot = _cross_and_dot(before, here, after)
    return cross > 0.0 and cross >= tangent * dot


@njit(cache=True)
def _turns(points, quads):
    """By how much each quad, (q, 4), turns left at a and at b; (q, 2)."""
    turns = np.empty((len(quads), 2))
    for q in range(len(quads)):
        a, b, c, d = quads[q]
        turns[q, 0] = np.arctan2(*_cross_and_dot(points[c], points[a], points[d]))
        turns[q, 1] = np.arctan2(*_cross_and_dot(points[d], points[b], points[c]))
    return turns


@njit(cache=True)
def shared_edge(twin, t, u):
    """The half-edge of triangle t across which triangle u lies; -1 where they are no neighbours."""
    for s in range(3):
        if twin[t, s] // 3 == u:  # -1 // 3 is -1, which is no triangle; in a tree there is one such edge at most
            return 3 * t + s
    return -1
