"""Joining keyframes: matched each with the next, threaded, and for a loop closed; triangles for every leg."""

import itertools
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tween.geometry.triangulation import Triangulation
from tween.morphing.keyframes.closing import closed
from tween.morphing.keyframes.keyframe import Bridge, Keyframe, Matcher, choose_disks
from tween.morphing.keyframes.subdivision import subdivided
from tween.morphing.keyframes.threads import MERGE, Threads, thread
from tween.morphing.matching.match import is_valid

_MOST_CLOSINGS = 8
"""Legs that are tried for closing a loop, the last one first."""

_PAIRS = (2, 8, 24)  # places where a leg is matched anew, one number after the other


class Joined(NamedTuple):
    """Keyframes joined.

    Attributes
    ----------
    threads : Threads
        All vertices.
    bridges : list of Bridge
        From each keyframe to the next; the triangles are of their nodes.
    """

    threads: Threads
    bridges: list[Bridge]

    @property
    def energy(self) -> float:
        """Of all legs together."""
        return sum(bridge.energy for bridge in self.bridges)

    def ends(self) -> list[tuple[Triangulation, Triangulation]]:
        """The two triangulations of every leg, of all vertices."""
        threads, k = self.threads, len(self.threads.keyframes)
        legs, n = [], len(threads.places)
        for i, (bridge, nodes) in enumerate(zip(self.bridges, threads.nodes, strict=True)):
            first = subdivided(bridge.first, nodes, n)
            last = first if bridge.complete else subdivided(bridge.last, nodes, n)
            source = Triangulation(threads.points[:, i], first)
            points = threads.points[:, (i + 1) % k]
            legs.append((source, source.moved(points) if bridge.complete else Triangulation(points, last)))
        return legs

    def holds(self) -> bool:
        """Whether all triangles are counter-clockwise, exactly, and all curves turn once."""
        return all(is_valid(T, T) for pair in self.ends() for T in pair)


def join(keyframes: list[Keyframe], loop: bool, landmarks: Sequence[Sequence[int]] = ()) -> Joined:
    """Match keyframes, each with the next, and give all of them the same vertices.

    Parameters
    ----------
    keyframes : list of Keyframe
    loop : bool
        Whether there is a leg from the last to the first.
    landmarks : sequence of sequence of int
        Rows that have to correspond, one of each keyframe.

    Returns
    -------
    Joined
    """
    matcher = Matcher(keyframes, landmarks)
    disks = choose_disks([len(k.disks) for k in keyframes], matcher.energy, loop)
    found = _round(matcher, disks, MERGE) if loop else _line(matcher, disks, MERGE)
    if not found.holds():
        found = _round(matcher, disks, 0.0) if loop else _line(matcher, disks, 0.0)
    return found


def _line(matcher: Matcher, disks: Sequence[int], merge: float) -> Joined:
    bridges = [matcher.bridge(i, disks) for i in range(len(matcher.keyframes) - 1)]
    return Joined(thread(matcher.keyframes, bridges, merge), bridges)


def _round(matcher: Matcher, disks: Sequence[int], merge: float) -> Joined:
    """Close the loop on the leg where that leaves the least energy in all.

    Where no leg can be closed, the legs together shift the shapes too much.  Then one leg after the other is matched
    anew, so that some places come to where the other legs lead them, until another leg can be closed.
    """
    k = len(matcher.keyframes)
    legs = [k - 1] if k == 2 else [k - 1 - j for j in range(min(k, _MOST_CLOSINGS))]
    tried = {leg: _closed_on(matcher, disks, leg, merge, {}) for leg in legs}
    best = min(tried.values(), key=_energy)
    for most, (leg, joined) in itertools.product(_PAIRS, tried.items()):
        if np.isfinite(best.energy) or not matcher.free or k > len(legs):
            break
        closing = joined.bridges[leg]
        few = np.arange(most) * len(closing.source) // most
        anew = matcher.anew(leg, disks, closing.source[few], closing.target[few])
        if anew is not None:
            others = [_closed_on(matcher, disks, other, merge, {leg: anew}) for other in legs if other != leg]
            best = min(best, *others, key=_energy)
    return best


def _energy(joined: Joined) -> float:
    return joined.energy


def _closed_on(matcher: Matcher, disks: Sequence[int], leg: int, merge: float, anew: Mapping[int, Bridge]) -> Joined:
    """Close the loop on one leg; the others are matched, unless they have been anew."""
    k = len(matcher.keyframes)
    order = [(leg + 1 + j) % k for j in range(k)]
    bridges = [anew.get(i) or matcher.bridge(i, disks) for i in order[:-1]]
    threads = thread([matcher.keyframes[i] for i in order], bridges, merge)
    if k == 2:
        bridges.append(bridges[0].reversed())
        threads.nodes.append(threads.nodes[0])
    else:
        ends = [matcher.keyframes[i].disks for i in (order[-1], order[0])]
        meant = ends[0][disks[order[-1]]], ends[1][disks[order[0]]]
        closing, nodes = closed(threads, meant, (len(ends[0]) == 1, len(ends[1]) == 1))
        bridges.append(closing)
        threads.nodes.append(nodes)
    start = order.index(0)
    return Joined(threads.rolled(start), [*bridges[start:], *bridges[:start]])
