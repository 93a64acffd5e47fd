r"""Playing a morph back: few times between which straight motion stays close to the morph, and is verified.

Players draw frames and, between them, straight motion: so do the animations of SVG, CSS and most programs.  What they
show is then not the morph, however it was proved, but a polygon through some of its shapes.  `playback` chooses these:

    samples      o  o o o o o  o    o     o    o   o   denser where the morph bends or starts fast
    playback     o------o------o---------------o---o   as far each time as the next rules allow

From each time the next is the last one such that the straight motion to it stays within the tolerance of the morph at
all samples between, and keeps the rules of `tween.measuring.straight_motion` at every instant.  Going as far as
possible each time takes the fewest times among the samples where a part of a good step is a good step, which may fail
in rare cases.

Legend: ``i j`` samples; ``k`` times of the playback; ``n`` vertices; a shape's *width* is the longer side of its
bounding box.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import TweenError
from tween.measuring.certificate import Certificate, moment, verify

_FIRST = 65  # samples
_BENT = 0.25  # of the tolerance: how far a sample may lie off the middle of its neighbours
_UNSEEN = 1 / 16  # of the tolerance: what happens between samples as close as that
_SHORTEST = 2.0**-300  # of time, between samples; elsewhere than near 0 doubles are farther apart
_MOST_NUMBERS = 2**24  # vertices times samples


@dataclass(frozen=True, eq=False)
class Playback:
    """Frames of a morph, straight motion between which is verified; made by `playback`.

    Attributes
    ----------
    times : ndarray of float64, shape (k,)
        From 0 to 1; not evenly spaced.
    frames : ndarray of float64, shape (k, n, 2)
        The shapes at those times.
    triangles : ndarray of int64, shape (k, n-2, 3)
        Triangles that show each of them to be a disk.
    tolerance, deviation : float
        How far, in widths of the shape, a vertex may be, and at most was where that was measured, from where the morph
        has it at the same time.
    certificate : Certificate
        What `tween.verify` says of these arrays with ``between="linear"``.
    """

    times: NDArray[np.float64]
    frames: NDArray[np.float64]
    triangles: NDArray[np.int64]
    tolerance: float
    deviation: float
    certificate: Certificate

    def __len__(self) -> int:
        return len(self.times)


def playback(m: Any, tolerance: float = 1e-3, most: int = 1000) -> Playback:
    """Choose few times at which to take frames, so that straight motion between them shows a morph, verified.

    Parameters
    ----------
    m : Morph
        Or what has `at`, `triangles_at` and `events` like it.
    tolerance : float
        How far a vertex may be from where the morph has it, as a fraction of the width of the shape at that time, the
        longer side of its bounding box.
    most : int
        Times, 0 and 1 included.

    Returns
    -------
    Playback
        Its certificate is valid.

    Raises
    ------
    TweenError
        Where the morph cannot be followed that closely, with a verified step each time and at most so many times; it
        names the time and the rule.
    ValueError
        Where the tolerance is not positive or fewer than two times are allowed.

    Notes
    -----
    The distance is measured, at samples as close as that takes, down to neighbouring doubles: of two shapes that differ
    in size by many powers of ten, the smaller one changes as close to its end as that.  That every instant bounds an
    immersed disk is checked, exactly, whatever the morph promises.  Some thousands of shapes are made, and O(log k)
    straight motions are checked for each time.

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ell"))
    >>> shown = playback(morph(T, T.on_disk(), path="slide"), tolerance=0.01)
    >>> bool(shown.certificate), shown.certificate.scope, shown.deviation <= 0.01, len(shown) < 20
    (True, 'playback', True, True)
    """
    if not 0 < tolerance < np.inf:
        raise ValueError(f"tolerance is {tolerance!r}, expected a positive fraction of the shape's width")
    if most < 2:
        raise ValueError(f"at most {most} times are asked for, expected at least 2: the source and the target")
    samples = _sampled(m, tolerance)
    chosen = _chosen(samples, tolerance, most)
    times, frames = samples.t[chosen], samples.shapes[chosen]
    triangles = np.stack([samples.triangles(i) for i in chosen])
    deviation = max(samples.deviation(i, j) for i, j in pairwise(chosen))
    certificate = verify(frames, triangles, times, between="linear")
    assert certificate, certificate.first_failure  # every step was verified
    return Playback(times, frames, triangles, float(tolerance), deviation, certificate)


@dataclass
class _Samples:
    """A morph at times, in order, and what was found of single shapes."""

    m: Any
    t: NDArray[np.float64]
    shapes: NDArray[np.float64]
    lists: dict[float, NDArray[np.int64]] = field(default_factory=dict)

    def insert(self, t: NDArray[np.float64], shapes: NDArray[np.float64]) -> None:
        places = np.searchsorted(self.t, t)
        self.t, self.shapes = np.insert(self.t, places, t), np.insert(self.shapes, places, shapes, axis=0)

    def triangles(self, i: int) -> NDArray[np.int64]:
        """Triangles that hold at a sample: at a flip those before it if, by rounding, those after it do not yet."""
        t = float(self.t[i])
        if t not in self.lists:
            now = self.m.triangles_at(t)
            before = self.m.triangles_at(float(np.nextafter(t, 0.0)))
            same = bool((now == before).all())
            self.lists[t] = now if same or verify(self.shapes[i], now) or not verify(self.shapes[i], before) else before
        return self.lists[t]

    def deviation(self, i: int, j: int) -> float:
        """How far straight motion from i to j is from the samples between, in widths of these."""
        s = (self.t[i + 1 : j] - self.t[i]) / (self.t[j] - self.t[i])
        off = self.shapes[i + 1 : j] - self.shapes[i] - s[:, None, None] * (self.shapes[j] - self.shapes[i])
        return float(_in_widths(off, self.shapes[i + 1 : j]).max(initial=0.0))

    def complaint(self, i: int, j: int, tolerance: float) -> str:
        """Why straight motion from i to j will not do; empty where it does."""
        deviation = self.deviation(i, j)
        if deviation > (1 - _UNSEEN) * tolerance:
            return f"straight motion is {deviation:.3g} widths away from it"
        lists = np.stack([self.triangles(i), self.triangles(j)])
        failure = verify(self.shapes[[i, j]], lists, self.t[[i, j]], between="linear").first_failure
        return f"at t = {moment(failure.t)} {failure.rule}".replace("frames 0 and 1", "the two") if failure else ""


def _in_widths(off: NDArray[np.float64], shapes: NDArray[np.float64]) -> NDArray[np.float64]:
    """The largest distance of each shape's vertices, in the widths of the shapes."""
    return np.hypot(*off.T).max(axis=0) / np.ptp(shapes, axis=1).max(axis=1)


def _sampled(m: Any, tolerance: float) -> _Samples:
    """The morph at so many times that it hardly bends between two of them; at its flips, too."""
    t = np.union1d(np.linspace(0.0, 1.0, _FIRST), [event.time for event in m.events])
    samples = _Samples(m, t, m.at(t))
    left = np.flatnonzero(_can_be_halved(t[:-1], t[1:]))
    while len(left):
        middle = 0.5 * (samples.t[left] + samples.t[left + 1])
        shapes = m.at(middle)
        off = shapes - 0.5 * (samples.shapes[left] + samples.shapes[left + 1])
        bent = _in_widths(off, shapes) > _BENT * tolerance
        if (len(samples.t) + len(left)) * shapes.shape[1] > _MOST_NUMBERS:
            raise _too_fast(middle[np.flatnonzero(bent)[0]], tolerance)
        samples.insert(middle, shapes)
        again = np.searchsorted(samples.t, middle[bent])
        again = np.sort(np.concatenate([again - 1, again]))
        apart = _can_be_halved(samples.t[again], samples.t[again + 1])
        for i in again[~apart].tolist():
            _check_leap(samples, i, tolerance)
        left = again[apart]
    return samples


def _can_be_halved(start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether doubles have a time between two others."""
    middle = 0.5 * (start + end)
    return np.asarray((start < middle) & (middle < end) & (end - start >= 2 * _SHORTEST))


def _check_leap(samples: _Samples, i: int, tolerance: float) -> None:
    """Between neighbouring doubles there is nothing to follow; but a leap that people would see is no motion."""
    width = float(np.ptp(samples.shapes, axis=1).max())
    if np.hypot(*(samples.shapes[i + 1] - samples.shapes[i]).T).max() > tolerance * width:
        raise _too_fast(samples.t[i], tolerance)


def _too_fast(t: float, tolerance: float) -> TweenError:
    return TweenError(f"at t = {moment(t)} the morph is too fast to be followed within {tolerance:g} widths")


def _chosen(samples: _Samples, tolerance: float, most: int) -> list[int]:
    """The samples to show, from each one the farthest that can be reached."""
    chosen, step = [0], 1
    while chosen[-1] < len(samples.t) - 1:
        if len(chosen) == most:
            t = moment(samples.t[chosen[-1]])
            raise TweenError(f"{most} times lead only to t = {t} within {tolerance:g} of the shape's width")
        i = chosen[-1]
        j = _farthest(samples, i, tolerance, step)
        while j == i:
            _halve(samples, i, tolerance)
            j = _farthest(samples, i, tolerance, 1)
        step = j - i
        chosen.append(j)
    return chosen


def _farthest(samples: _Samples, i: int, tolerance: float, step: int) -> int:
    """The last sample that straight motion from i may lead to, i itself for none; the step is a guess."""
    last = len(samples.t) - 1
    low, high = i, last + 1  # low can be reached, high cannot
    while high - low > 1:
        j = min(low + step, high - 1) if high > last else (low + high) // 2
        if samples.complaint(i, j, tolerance):
            high = j
        else:
            low, step = j, 2 * step
    return low


def _halve(samples: _Samples, i: int, tolerance: float) -> None:
    """Put a sample between i and the next one, which cannot be reached; or say why that would not help."""
    start, end = samples.t[[i, i + 1]]
    complaint = samples.complaint(i, i + 1, tolerance)
    if not _can_be_halved(start, end):
        raise TweenError(
            f"the morph cannot be played back from t = {moment(start)} on: {complaint}, and doubles have no time in "
            "between; between shapes more alike in size it moves more slowly there"
        )
    t = np.array([0.5 * (start + end)])
    samples.insert(t, samples.m.at(t))
