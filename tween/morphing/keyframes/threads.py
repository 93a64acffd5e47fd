r"""Threads: one numbering of vertices for a whole sequence of keyframes.

A *thread* is one vertex of the sequence: it has a place on every keyframe.  Every node of every bridge is on a thread,
and a vertex of a keyframe makes a node of the bridge before it one with a node of the bridge after it:

    keyframe 0        1        2
            v --------o                      a thread of a vertex of keyframe 0; beyond 1 it is free
            .         w -------o             one of a vertex of keyframe 1, for which bridge 0 inserted nothing
            .         .        .

Where no bridge says where a thread goes, it is *free*: it lies between the same two nodes on both keyframes, in
proportion.  There is no vertex between two neighbouring nodes, so it lies on a straight edge on both, and its image
moves along with the edge.  What matters is that the threads have one order on all keyframes; where two of them would
come too close to each other, free ones give way.

Legend: ``i`` a keyframe, and the bridge from it to the next; ``t`` threads; ``p q`` places of nodes on both.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tween.morphing.keyframes.keyframe import Bridge, Keyframe

MERGE = 0.02
"""Of the room around a node: so near to a thread that is no vertex, it is put on that thread."""

_SAME = 1e-9  # of an edge; nodes nearer to a thread than that are always put on it
_CLOSE, _EVEN = 1e-4, 0.01  # free threads closer than the first share of their room are spread, by so much

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]
_Bools = NDArray[np.bool_]


@dataclass
class Threads:
    """All threads, in order along the curves.

    Attributes
    ----------
    keyframes : list of Keyframe
    places : ndarray of float64, shape (n, k)
        On each keyframe, unrolled: every column rises, by less than once around.
    points : ndarray of float64, shape (n, k, 2)
    fixed : ndarray of bool, shape (n, k)
        Whether a bridge says so.
    nodes : list of ndarray of int
        For every bridge, the thread of each node.
    """

    keyframes: list[Keyframe]
    places: _Floats
    points: _Floats
    fixed: _Bools
    nodes: list[_Ints]

    @property
    def vertices(self) -> _Ints:
        """Row of the input that each thread is on each keyframe, shape (k, n); -1 where it was inserted."""
        rows = []
        for i, keyframe in enumerate(self.keyframes):
            place = self.places[:, i]
            vertex = np.floor(place).astype(np.int64)
            rows.append(np.where(place == vertex, keyframe.rows[vertex % len(keyframe)], -1))
        return np.stack(rows)

    def rolled(self, keyframes: int) -> "Threads":
        """Begin with another keyframe, and there with the thread of vertex 0, or the first after it."""
        order = np.roll(np.arange(len(self.keyframes)), -keyframes)
        frames = [self.keyframes[i] for i in order]
        n, periods = len(self.places), np.array([len(keyframe) for keyframe in frames])
        threads = np.roll(np.arange(n), -int(np.argmin(self.places[:, order[0]] % periods[0])))
        number = np.empty(n, np.int64)
        number[threads] = np.arange(n)
        places = self.places[threads][:, order]
        return Threads(
            frames,
            np.where(np.arange(n)[:, None] < n - threads[0], places, places + periods),
            self.points[threads][:, order],
            self.fixed[threads][:, order],
            [number[self.nodes[i]] for i in order],
        )


def thread(keyframes: list[Keyframe], bridges: list[Bridge], merge: float = MERGE) -> Threads:
    """Join the nodes of bridges to threads through all keyframes.

    Parameters
    ----------
    keyframes : list of Keyframe
    bridges : list of Bridge
        From each to the next.
    merge : float
        See `MERGE`; with 0 nothing is moved.

    Returns
    -------
    Threads
        Beginning with vertex 0 of the first keyframe.
    """
    n, k = len(keyframes[0]), len(keyframes)
    threads = Threads(keyframes, np.full((n, k), np.nan), np.full((n, k, 2), np.nan), np.zeros((n, k), np.bool_), [])
    threads.places[:, 0], threads.points[:, 0], threads.fixed[:, 0] = np.arange(n), keyframes[0].points, True
    for i, bridge in enumerate(bridges):
        _go_on(threads, i, bridge, merge)
    for i, keyframe in enumerate(keyframes):
        _spread(threads, i, len(keyframe))
        free = np.isnan(threads.points[:, i, 0])
        threads.points[free, i] = keyframe.at(threads.places[free, i])
    return threads


def _go_on(threads: Threads, i: int, bridge: Bridge, merge: float) -> None:
    """Lead all threads from keyframe i to the next; nodes that are on none make new ones."""
    here, there = (len(keyframe) for keyframe in threads.keyframes[i : i + 2])
    place = _unrolled(bridge.source, threads.places[0, i], here)
    nodes = _claimed(threads, i, place, merge)
    if (nodes < 0).any():
        nodes = _grown(threads, i, place, nodes)
    own = ~threads.fixed[nodes, i]
    threads.places[nodes[own], i], threads.points[nodes[own], i] = place[own], bridge.source_points[own]
    m, start = len(nodes), int(np.argmin(nodes))
    ahead = (start + np.arange(m)) % m
    threads.places[nodes[ahead], i + 1] = bridge.target[ahead] + there * (start + np.arange(m) >= m)
    threads.points[nodes, i + 1] = bridge.target_points
    threads.fixed[nodes, i] = threads.fixed[nodes, i + 1] = True
    threads.nodes.append(nodes)
    free = np.isnan(threads.places[:, i + 1])
    x, y = threads.places[~free, i], threads.places[~free, i + 1]
    threads.places[free, i + 1] = _proportional(threads.places[free, i], x, y, here, there)


def _unrolled(places: _Floats, start: float, period: int) -> _Floats:
    """The same places, once around from a start; vertices stay whole numbers."""
    return np.asarray(places + period * np.ceil((start - places) / period))


def _proportional(wanted: _Floats, x: _Floats, y: _Floats, period: int, image: int) -> _Floats:
    """The images of places by those of others, in proportion between these; both rise once around."""
    x = np.concatenate([x - period, x, x + period])
    y = np.concatenate([y - image, y, y + image])
    return np.asarray(np.interp(wanted, x, y))


def _claimed(threads: Threads, i: int, place: _Floats, merge: float) -> _Ints:
    """The thread of each node of a bridge on its first keyframe; -1 where it has to make one."""
    period, own = len(threads.keyframes[i]), threads.places[:, i]
    after = np.searchsorted(own, place)
    around = np.concatenate([[own[-1] - period], own, [own[0] + period]])
    offsets = np.stack([around[after], around[after + 1]]) - place
    nearer = np.argmin(np.abs(offsets), axis=0)
    offset, nearest = offsets[nearer, np.arange(len(place))], (after - 1 + nearer) % len(own)
    steps = (np.roll(place, -1) - place) % period
    room = np.minimum(steps, np.roll(steps, 1))
    vertex = place == np.floor(place)
    near = np.abs(offset) <= np.maximum(merge * room, _SAME)
    near = np.where(vertex, offset == 0, near & (own[nearest] != np.floor(own[nearest])))
    nodes = np.full(len(place), -1)
    for j in sorted(np.flatnonzero(near).tolist(), key=lambda j: -abs(offset[j])):
        nodes[nodes == nearest[j]] = -1  # of several nodes that would take one thread, the nearest does
        nodes[j] = nearest[j]
    return _in_order(nodes, place, np.where(nodes >= 0, offset, 0.0), period)


def _in_order(nodes: _Ints, place: _Floats, offset: _Floats, period: int) -> _Ints:
    """Let go of threads that lie beyond the place of a neighbouring node."""
    order = np.argsort(place)
    moved = (place + offset)[order]
    crossed = np.append(moved[1:], moved[0] + period) <= moved
    lost = np.empty(len(place), np.bool_)
    lost[order] = crossed | np.roll(crossed, 1)
    return np.where(lost & (place != np.floor(place)), -1, nodes)


def _grown(threads: Threads, i: int, places: _Floats, nodes: _Ints) -> _Ints:
    """Make a thread for each node that has none; on the keyframes before, it lies in proportion."""
    period, own = len(threads.keyframes[i]), threads.places[:, i]
    new = np.flatnonzero(nodes < 0)
    new = new[np.argsort(places[new])]
    place = places[new]
    rows = np.full((len(new), threads.places.shape[1]), np.nan)
    rows[:, i] = place
    for k in range(i):
        rows[:, k] = _proportional(place, own, threads.places[:, k], period, len(threads.keyframes[k]))
    at = np.searchsorted(own, place)
    threads.places = np.insert(threads.places, at, rows, axis=0)
    threads.points = np.insert(threads.points, at, np.nan, axis=0)
    threads.fixed = np.insert(threads.fixed, at, False, axis=0)
    shift = np.searchsorted(at, np.arange(len(own)), side="right")
    threads.nodes = [old + shift[old] for old in threads.nodes]
    result = np.where(nodes >= 0, nodes + shift[nodes], -1)
    result[new] = at + np.arange(len(new))
    return result


def _spread(threads: Threads, i: int, period: int) -> None:
    """Give free threads room where they come too close to each other or to fixed ones, changing no order."""
    place, fixed = threads.places[:, i], np.flatnonzero(threads.fixed[:, i])
    n = len(place)
    for a, b in zip(fixed.tolist(), [*fixed[1:].tolist(), int(fixed[0]) + n], strict=True):
        if b - a < 2:
            continue
        inner = np.arange(a + 1, b)
        low, high = place[a], place[b % n] + period * (b // n)
        share = (place[inner % n] + period * (inner // n) - low) / (high - low)
        count = len(inner)
        if np.diff(np.concatenate([[0.0], share, [1.0]])).min() * (count + 1) < _CLOSE:
            share = (1 - _EVEN) * np.sort(np.clip(share, 0.0, 1.0)) + _EVEN * np.arange(1, count + 1) / (count + 1)
            place[inner % n] = low + share * (high - low) - period * (inner // n)
