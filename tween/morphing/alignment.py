"""Vertex correspondence by pivot triangle matching (Section 6.1), and common triangulations.

Legend: ``s t`` triangles, nodes of the dual tree; ``i j k`` vertices; ``shift`` as in
`tween.compatible_shift`: vertex i of the source is vertex ``(i + shift) mod n`` of the target.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.choices import SHIFT_RULES, Shifts
from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.incompatible.flip_sequence import count_crossings
from tween.morphing.incompatible.pivots import pivot_shift, spine
from tween.triangulating.costs import distortion
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh
from tween.triangulating.table.splits import is_small


@dataclass(frozen=True)
class Alignment:
    """Two shapes brought to the same numbers: vertex i of one corresponds to vertex i of the other.

    Attributes
    ----------
    source, target : Triangulation
        With equally many vertices; the target renumbered.
    shift : int
        Vertex i was vertex ``(i + shift) mod n`` of the target before, inserted vertices counted.
    source_vertices, target_vertices : ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.
    source_spine, target_spine : ndarray of int
        Triangles along the spines, from end to end.
    pivot : int or None
        The vertex at which the pivot triangles meet; None where none was used.
    crossings : int
        Between the two triangulations; 0 where they are the same.
    """

    source: Triangulation
    target: Triangulation
    shift: int
    source_vertices: NDArray[np.int64]
    target_vertices: NDArray[np.int64]
    pivot: int | None
    crossings: int

    @cached_property
    def source_spine(self) -> NDArray[np.int64]:
        """Triangles of the source along its spine."""
        return spine(self.source)

    @cached_property
    def target_spine(self) -> NDArray[np.int64]:
        """Triangles of the target along its spine, ties broken in the numbers that it had before."""
        return spine(self.target.rolled(-self.shift))

    def exchanged(self) -> "Alignment":
        """Source and target exchanged, in the numbers that the target had before.

        Returns
        -------
        Alignment
        """
        n, k = len(self.source), self.shift
        if k == 0:  # nothing to renumber, as in each of very many morphs to a disk
            return replace(
                self,
                source=self.target,
                target=self.source,
                source_vertices=self.target_vertices,
                target_vertices=self.source_vertices,
            )
        return Alignment(
            self.target.rolled(-k),
            self.source.rolled(-k),
            -k % n,
            np.roll(self.target_vertices, k),
            np.roll(self.source_vertices, k),
            None if self.pivot is None else (self.pivot + k) % n,
            self.crossings,
        )


def align(source: Any, target: Any, shifts: Shifts = "pivots") -> Alignment:
    """Bring two shapes to equal numbers of vertices and match them.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        Vertices are inserted on the one with fewer (`Curve.insert_vertices`: longest edges first), so that
        its shape stays.  A curve stands for its constrained Delaunay triangulation; so does a
        triangulation that has to take up vertices.
    shifts : {"pivots", "all"} or int
        "pivots": match an end of one spine with an end of the other.  The paper says "choose one" of
        the two ends; of the four pairings we take the one whose triangulations cross least, the
        first of equally good ones.  "all": of all n renumberings take the one with a triangulation
        that is valid in both curves and distorts least, and return that triangulation.  A number:
        that very renumbering.

    Returns
    -------
    Alignment

    Raises
    ------
    NotSelfOverlappingError
        Where a curve bounds no immersed disk.
    IncompatibleError
        For "all", where no renumbering allows a common triangulation.

    Notes
    -----
    "pivots" costs O(n**2) for the crossings; "all" a joint table for each of n renumberings.

    Examples
    --------
    >>> from tween import gallery
    >>> a = align(gallery.curve("ell"), gallery.curve("spiral_1"))
    >>> len(a.source) == len(a.target), a.pivot in a.source.triangles[a.source_spine[[0, -1]]]
    (True, True)

    References
    ----------
    Mukherjee and Gopi, Section 6.1.
    """
    check_shifts(shifts)
    first, second, *origins = equal_counts(source, target)
    n = len(first)
    if shifts == "pivots":
        return renumbered(first, second, *pivot_shift(first, second), *origins)
    if shifts != "all":
        return renumbered(first, second, int(shifts) % n, None, *origins)
    found = least_distorted(first, second)
    if found is None:
        raise IncompatibleError(
            f"the curves have no common triangulation under any of {n} renumberings; shifts='pivots' needs none"
        )
    shift, shared = found
    return renumbered(shared, Triangulation(second.points, (shared.triangles + shift) % n), shift, None, *origins)


def check_shifts(shifts: Shifts) -> None:
    """Raise where renumberings are asked for in words that mean nothing.

    Parameters
    ----------
    shifts : {"pivots", "all"} or int

    Raises
    ------
    ValueError
        For anything else.
    """
    if shifts not in SHIFT_RULES and (isinstance(shifts, str) or int(shifts) != shifts):
        raise ValueError(f"shifts is {shifts!r}, expected 'pivots', 'all' or a whole number")


def renumbered(
    first: Triangulation,
    second: Triangulation,
    shift: int,
    pivot: int | None,
    first_origin: NDArray[np.int64],
    second_origin: NDArray[np.int64],
) -> Alignment:
    """Renumber the second shape and say how the two then stand to each other.

    Parameters
    ----------
    first, second : Triangulation
        With equally many vertices.
    shift : int
    pivot : int or None
    first_origin, second_origin : ndarray of int, shape (n,)
        Which vertex of the input each vertex is.

    Returns
    -------
    Alignment
    """
    moved = second.rolled(shift)
    return Alignment(
        first,
        moved,
        shift,
        first_origin,
        np.roll(second_origin, -shift),
        pivot,
        0 if np.array_equal(first.canonical, moved.canonical) else count_crossings(first, moved),
    )


def equal_counts(source: Any, target: Any) -> tuple[Triangulation, Triangulation, NDArray[np.int64], NDArray[np.int64]]:
    """Triangulate both with as many vertices as the larger has.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)

    Returns
    -------
    first, second : Triangulation
    first_origin, second_origin : ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.

    Raises
    ------
    CurveError
        Where one is no curve.
    NotSelfOverlappingError
        Where a curve bounds no immersed disk; the message says which of the two, and why.
    """
    curves = as_curve(source), as_curve(target)
    count = max(map(len, curves))
    shapes, origins = [], []
    for name, shape, curve in zip(("source", "target"), (source, target), curves, strict=True):
        rows = np.arange(len(curve)) if isinstance(shape, (Curve, Triangulation)) else curve.origin
        if len(curve) < count:
            curve = Curve(curve.points).insert_vertices(count)
            rows = np.where(curve.origin < 0, -1, rows[curve.origin])
        kept = isinstance(shape, Triangulation) and len(shape) == count
        shapes.append(shape if kept else _triangulated(name, curve))
        origins.append(rows.astype(np.int64))
    return shapes[0], shapes[1], origins[0], origins[1]


def _triangulated(name: str, curve: Curve) -> Triangulation:
    """The constrained Delaunay triangulation of the source, or of the target; or why there is none."""
    answer = decompose(curve)
    if not answer:
        raise NotSelfOverlappingError(f"the {name} bounds no immersed disk: {answer.reason}")
    return remesh(answer.arbitrary())


def common(first: Triangulation, second: Triangulation, most: int | None = None) -> Triangulation | None:
    """Find the least distorting triangulation that is valid in two shapes as they are numbered.

    Parameters
    ----------
    first, second : Triangulation
        With equally many vertices.
    most : int, optional
        Of pairs in the joint table, see `.table.splits`: where more would hold, none is looked for.

    Returns
    -------
    Triangulation or None
        Of the first shape; None where none is valid in both.
    """
    if most is not None and not is_small(np.stack([first.points, second.points]), most):
        return None
    both = decompose(first.curve, second.curve)
    return both.optimal(distortion(first.points, second.points)) if both else None


def least_distorted(first: Triangulation, second: Triangulation) -> tuple[int, Triangulation] | None:
    """Over all renumberings, find the common triangulation of least distortion.

    Parameters
    ----------
    first, second : Triangulation
        With equally many vertices.

    Returns
    -------
    (int, Triangulation) or None
        The shift and the triangulation, of the first shape; None where no renumbering allows one.
    """
    best, least = None, np.inf
    for shift in range(len(first)):
        moved = second.rolled(shift)
        found = common(first, moved)
        if found is not None:
            cost = float(distortion(first.points, moved.points)(found.triangles).sum())
            if cost < least:
                best, least = (shift, found), cost
    return best
