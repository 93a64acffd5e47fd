r"""Sequences: morphs through several keyframes, with one numbering of vertices all the way.

    keyframes   A ------ B ------ C ------ A        legs are morphs; on both sides of a keyframe stands the same array
    times       0   leg  1   leg  2   leg  3
                ease     ease     ease

Neighbours are matched, the matches are joined to threads (`.keyframes.threads`), and every leg is a morph under its
match's triangles, split where threads lie on their edges.  At a keyframe the triangles of the next leg take over: both
lists show the same disk there.

Legend: ``i`` a leg, or the keyframe where it starts; ``s`` time of a leg, 0 to 1; ``t`` time of the sequence.
"""

from collections.abc import Sequence as Several
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.choices import PACES, PATHS, PLACEMENTS, ROOT_RULES, Pace, Path, Placement, RootRule
from tween.easing import AnyEase, Ease, as_ease
from tween.errors import GuaranteeError, IncompatibleError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import Alignment
from tween.morphing.incompatible.flip_sequence import count_crossings
from tween.morphing.keyframes.joining import Joined, join
from tween.morphing.keyframes.keyframe import Keyframe
from tween.morphing.keyframes.legs import Legs, Schedule
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph_as_numbered

Shape = Triangulation | Curve | ArrayLike
_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


class Sequence(Morph):
    """A morph through several keyframes; made by `tween.sequence`.

    It answers everything that a `Morph` does; a time from 0 to 1 leads through all keyframes.  At the time of a
    keyframe the diagonals of the next leg replace those of the last one: as many `events` as diagonals change, though
    no single one of them need be a flip.

    Attributes
    ----------
    keyframes : tuple of Triangulation
        Each with all vertices, under the triangles of the leg that starts there.  Of a loop the first is not repeated.
    vertices : ndarray of int, shape (keyframes, n)
        Which row of its input each vertex of a keyframe is; -1 where it was inserted.
    times : ndarray of float64
        When each keyframe is reached, from 0 to 1; of a loop also when the first is reached again, 1.
    legs : tuple of Morph
        From each keyframe to the next.
    loop : bool
        Whether it ends as it began.
    """

    def __init__(self, joined: Joined, legs: list[Morph], schedule: Schedule, loop: bool) -> None:
        vertices = joined.threads.vertices
        self.legs, self.vertices, self.loop = tuple(legs), vertices, loop
        self.times = schedule.reached
        self.keyframes = tuple(leg.source for leg in legs) + (() if loop else (legs[-1].target,))
        motion = Legs(legs, schedule, loop)
        target = self.keyframes[0] if loop else Triangulation(legs[-1].target.points, motion.stages[-1][1])
        source = legs[0].source
        crossings = 0 if np.array_equal(source.canonical, target.canonical) else count_crossings(source, target)
        alignment = Alignment(source, target, 0, vertices[0], vertices[0 if loop else -1], None, crossings)
        super().__init__(motion, alignment, proof=legs[0].proof if all(leg.proof for leg in legs) else "")

    def __repr__(self) -> str:
        kind = "loop of " if self.loop else ""
        return f"Sequence({kind}{len(self.keyframes)} keyframes, {len(self.source)} vertices)"


def sequence(
    keyframes: Several[Shape],
    loop: bool = False,
    times: Several[float] | None = None,
    ease: AnyEase | Several[AnyEase] = "ease-in-out",
    hold: float = 0.0,
    *,
    path: Path = "metric",
    guarantee: bool = True,
    placement: Placement = "steady",
    root: RootRule = "disk-center",
    landmarks: Several[Several[int]] | None = None,
    names: Several[str] | None = None,
    pace: Pace = "auto",
) -> Sequence:
    """Morph through several immersed disks, one after the other, with one numbering of vertices.

    Parameters
    ----------
    keyframes : sequence of Triangulation, Curve or array_like of shape (n, 2)
        Two at least.  A triangulation says which immersed disk is meant, where its curve bounds several; for a curve
        that is chosen so that the energies of all matches add up to least.
    loop : bool
        Whether to go back from the last to the first; the first may stand at the end again, unless times or landmarks
        count it as a keyframe of its own.
    times : sequence of float, optional
        When each keyframe is reached, rising, in any unit; of a loop one more, for the first one again.  Evenly spaced
        unless given.
    ease : str, four float, or a sequence of these
        How each leg spends its time, see `tween.easing.as_ease`; one for all legs or one for each.
    hold : float
        For how long every keyframe rests, in the unit of the times, or else in times of a leg; at the start of a loop
        the first one does, at its end it does not.
    path, guarantee, placement, pace
        As for `tween.morph`; `ease` comes on top of the pace.
    root : {"disk-center", "tree-center"}
        As for `tween.morph`; of every leg.
    landmarks : sequence of sequence of int, optional
        Vertices that have to correspond, one of every keyframe, for each landmark.
    names : sequence of str, optional
        What messages call the keyframes besides their numbers, which start at 0.

    Returns
    -------
    Sequence

    Raises
    ------
    CurveError
        Where a keyframe is no curve; the message says which.
    NotSelfOverlappingError
        Where a keyframe bounds no immersed disk; the message says which, and why.
    IncompatibleError
        Where landmarks are none, or allow no match.
    GuaranteeError
        Where a guarantee cannot be given; the message says on which leg.
    ValueError
        For fewer than two keyframes, and for options that are none.

    Notes
    -----
    Every vertex of every keyframe is a vertex all the way: it lies on an edge of those that it does not belong to.  So
    there are as many vertices as all keyframes have, less those that are matched with each other.

    A loop closes exactly: its first and its last shape are equal, and vertex i is vertex i.  The matches of its legs,
    led around, do not come back to where they began; the leg for which it costs least takes up the difference.

    Examples
    --------
    >>> square, bar = [[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 0], [4, 0], [4, 1], [0, 1]]
    >>> s = sequence([square, bar, [[0, 0], [3, 0], [0, 3]]], loop=True)
    >>> s
    Sequence(loop of 3 keyframes, 4 vertices)
    >>> frames = s.frames(31)
    >>> bool((frames[0] == frames[-1]).all()), bool((frames[10] == s.keyframes[1].points).all())
    (True, True)
    """
    _check_options(path, placement, root, pace)
    shapes = list(keyframes)
    if loop and not _is_counted(len(shapes), times, landmarks):
        shapes = _without_return(shapes)
    called = _called(len(shapes), names)
    if len(shapes) < 2:
        found = "is 1 keyframe" if len(shapes) == 1 else "are 0 keyframes"
        raise ValueError(f"there {found}, expected at least 2; tween.triangulate takes a single shape")
    schedule = _scheduled(len(shapes), loop, times, ease, hold)
    frames = [Keyframe(shape, name) for shape, name in zip(shapes, called, strict=True)]
    joined = join(frames, loop, _checked_landmarks(landmarks, frames))
    legs = []
    for i, (source, target) in enumerate(joined.ends()):
        try:
            legs.append(morph_as_numbered(source, target, path, guarantee, placement, root, pace))
        except GuaranteeError as error:
            raise GuaranteeError(f"from {called[i]} to {called[(i + 1) % len(called)]}: {error}") from None
    return Sequence(joined, legs, schedule, loop)


def _check_options(path: str, placement: str, root: Any, pace: str) -> None:
    for name, value, allowed in (
        ("path", path, PATHS),
        ("placement", placement, PLACEMENTS),
        ("root", root, ROOT_RULES),
        ("pace", pace, PACES),
    ):
        if value not in allowed:
            raise ValueError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


def _is_counted(count: int, times: Several[float] | None, landmarks: Several[Several[int]] | None) -> bool:
    """Whether times or landmarks are given for so many keyframes, so that the last one of a loop is one of its own."""
    return (times is not None and np.shape(times) == (count + 1,)) or any(len(row) == count for row in landmarks or ())


def _without_return(shapes: list[Any]) -> list[Any]:
    """The keyframes of a loop without the first one at the end."""
    if len(shapes) < 3:
        return shapes
    first, last = (T.points if isinstance(T, Triangulation | Curve) else np.asarray(T) for T in (shapes[0], shapes[-1]))
    return shapes[:-1] if np.array_equal(first, last) else shapes


def _called(count: int, names: Several[str] | None) -> list[str]:
    if names is None:
        return [f"keyframe {i}" for i in range(count)]
    if isinstance(names, str) or len(names) not in (count, count + 1):
        raise ValueError(f"there are {len(names)} names for {count} keyframes")
    return [f"keyframe {i} ({names[i]})" for i in range(count)]


def _checked_landmarks(landmarks: Several[Several[int]] | None, frames: list[Keyframe]) -> list[list[int]]:
    """One row for each landmark, one vertex of every keyframe in it."""
    rows = []
    for row in [] if landmarks is None else landmarks:
        given = np.asarray(row)
        if given.shape != (len(frames),) or not np.issubdtype(given.dtype, np.integer):
            raise IncompatibleError(
                f"landmark {row!r} is none, expected {len(frames)} whole numbers, a vertex of every keyframe"
            )
        for vertex, keyframe in zip(given.tolist(), frames, strict=True):
            if keyframe.vertex(vertex) < 0:
                raise IncompatibleError(
                    f"landmark {tuple(given.tolist())} is out of range: {keyframe.name} has vertices 0 to "
                    f"{len(keyframe) - 1}"
                )
        rows.append(given.tolist())
    return rows


# Time


def _scheduled(count: int, loop: bool, times: Any, ease: Any, hold: Any) -> Schedule:
    legs = count if loop else count - 1
    reached = np.arange(legs + 1.0) if times is None else np.asarray(times, dtype=np.float64)
    if reached.shape != (legs + 1,) or not np.isfinite(reached).all() or (np.diff(reached) <= 0).any():
        again = ", the last one for the first keyframe again" if loop else ""
        raise ValueError(f"times are {times!r}, expected {legs + 1} rising numbers{again}")
    shortest = float(np.diff(reached).min())
    if times is None and isinstance(hold, int | float) and np.isfinite(hold) and hold >= 0:
        reached, shortest = reached * (1.0 + hold), np.inf
    if isinstance(hold, bool) or not isinstance(hold, int | float) or not 0 <= hold < shortest:
        raise ValueError(
            f"hold is {hold!r}, expected a number from 0 to less than the time from a keyframe to the next"
        )
    starts, stops = reached[:-1] + hold, reached[1:]
    end = stops[-1] + (0.0 if loop else hold)
    start, length = reached[0], end - reached[0]
    # Exactly 1 at the end: x / x.
    starts, stops, reached = ((x - start) / length for x in (starts, stops, reached))
    return Schedule(starts, stops, reached, _eases(ease, legs))


def _eases(ease: Any, legs: int) -> list[Ease]:
    """One for every leg, from one for all or a list."""
    several = isinstance(ease, list | tuple) and not all(isinstance(x, int | float) for x in ease)
    if not several:
        return [as_ease(ease)] * legs
    if len(ease) != legs:
        raise ValueError(f"there are {len(ease)} eases, expected one, or {legs}: one for each leg")
    return [as_ease(value) for value in ease]
