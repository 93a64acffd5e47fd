"""Legs one after the other: the motion of a sequence, and the time that each leg gets.

Legend: as in `tween.morphing.sequence`.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.easing import Ease
from tween.morphing.compatible.guarantee.rounding import Placing
from tween.morphing.incompatible.flow import Event
from tween.morphing.morph import Morph
from tween.morphing.plan import Plan

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


class Schedule(NamedTuple):
    """The time that each leg gets.

    Attributes
    ----------
    starts, stops : ndarray of float64, shape (legs,)
        When the legs start and stop, from 0 to 1.
    reached : ndarray of float64, shape (legs + 1,)
        When keyframes are reached.
    eases : list of Ease
        How legs move.
    """

    starts: _Floats
    stops: _Floats
    reached: _Floats
    eases: list[Ease]


class Legs:
    """Legs one after the other, as a `Motion`.

    Parameters
    ----------
    legs : list of Morph
    schedule : Schedule
    loop : bool
        Whether the last one leads back to the first keyframe.
    """

    def __init__(self, legs: list[Morph], schedule: Schedule, loop: bool) -> None:
        self._legs, self._schedule = legs, schedule
        self.stages: list[tuple[float, _Ints]] = []
        self.events: list[Event] = []
        for i, leg in enumerate(legs):
            rows = self._taken_over(float(schedule.reached[i]), leg.source.triangles)
            self._lead_through(i, leg, rows)
        if loop:
            self._taken_over(1.0, legs[0].source.triangles)
            self.stages.append((1.0, legs[0].source.triangles))

    def at(self, t: _Floats) -> _Floats:
        """The shapes at many times, shape (k, n, 2)."""
        starts, stops, _, eases = self._schedule
        leg = np.clip(np.searchsorted(self._schedule.reached, t, side="right") - 1, 0, len(self._legs) - 1)
        shapes = np.empty((len(t), len(self._legs[0].source), 2))
        for i in np.unique(leg):
            here = np.flatnonzero(leg == i)
            share = np.clip((t[here] - starts[i]) / (stops[i] - starts[i]), 0.0, 1.0)
            shapes[here] = self._legs[i].at(eases[i].at(share))
        return shapes

    def first_doubt(self, placing: Placing) -> tuple[float, float]:
        """Every leg proves its own shapes, and raises where it cannot."""
        for leg in self._legs:
            leg.guaranteed()
        return 0.0, 1.0

    def plans(self) -> list[Plan]:
        """Tell what all legs are made of, each stretched to the next keyframe."""
        return [plan for i, leg in enumerate(self._legs) for plan in self._plans_of(i, leg)]

    def _plans_of(self, i: int, leg: Morph) -> list[Plan]:
        starts, stops, reached, eases = self._schedule

        def inner(t: _Floats) -> _Floats:
            return eases[i].at(np.clip((t - starts[i]) / (stops[i] - starts[i]), 0.0, 1.0))

        plans = leg.plans()
        marks = [float(starts[i] + float(eases[i].when(np.array([p.stop]))[0]) * (stops[i] - starts[i])) for p in plans]
        last = float(reached[i + 1]) if i + 1 < len(self._legs) else 1.0
        marks = [float(reached[i]), *marks[:-1], last]
        return [p.timed(a, b, inner) for p, (a, b) in zip(plans, pairwise(marks), strict=True)]

    def _taken_over(self, time: float, triangles: _Ints) -> _Ints:
        """Exchange diagonals for those of other triangles; return the rows in which these stand from then on."""
        if not self.stages:
            return np.arange(len(triangles))
        old = self.stages[-1][1]
        out, into = (_diagonals(T) for T in (old, triangles))
        gone, come = sorted(out - into), sorted(into - out)
        self.events += [Event(time, a, b) for a, b in zip(gone, come, strict=True)]
        return _rows_kept(old, triangles)

    def _lead_through(self, i: int, leg: Morph, rows: _Ints) -> None:
        """Take on the stages and the events of a leg, in the time of the sequence."""
        starts, stops, reached, eases = self._schedule

        def when(s: float) -> float:
            share = float(eases[i].when(np.array([s]))[0])
            return float(starts[i] + share * (stops[i] - starts[i])) if s < 1 else float(stops[i])

        self.stages.append((float(reached[i]), leg.source.triangles[rows]))
        times = sorted({event.time for event in leg.events})
        self.stages += [(when(s), leg.triangles_at(s if s > 0 else np.nextafter(0.0, 1.0))[rows]) for s in times]
        self.events += [event._replace(time=when(event.time)) for event in leg.events]


def _diagonals(triangles: _Ints) -> set[tuple[int, int]]:
    n = len(triangles) + 2
    edges = {(int(a), int(b)) for T in triangles for a, b in zip(T, np.roll(T, -1), strict=True)}
    return {(a, b) for a, b in edges if a < b and (b, a) in edges and (b - a) % n != 1}


def _rows_kept(old: _Ints, new: _Ints) -> _Ints:
    """Rows of the new triangles, so that those that stay keep their places and the others come in order."""
    places = {tuple(T): row for row, T in enumerate(_smallest_first(old))}
    rows, free = np.full(len(new), -1), []
    for row, T in enumerate(_smallest_first(new)):
        place = places.pop(T, None)
        if place is None:
            free.append((T, row))
        else:
            rows[place] = row
    for (_, place), (_, row) in zip(sorted(places.items()), sorted(free), strict=True):
        rows[place] = row
    return rows


def _smallest_first(triangles: _Ints) -> list[tuple[int, ...]]:
    first = triangles.argmin(axis=1)
    return [
        tuple(row)
        for row in triangles[np.arange(len(triangles))[:, None], (first[:, None] + np.arange(3)) % 3].tolist()
    ]
