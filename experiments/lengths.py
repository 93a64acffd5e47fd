"""How lengths of edges go along a morph without flips: in proportion to the base that carries them, and as they are.

Legend: ``a b c`` corners of a triangle, ab its base; ``z = (c - a) / (b - a)`` its third vertex over a base from 0 to
1; ``k`` times, ``n`` vertices.
"""

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from tween import Morph
from tween.geometry.dual_tree import disk_center, hops, rooted

Floats = NDArray[np.float64]


def take_apart(m: Morph, times: ArrayLike) -> tuple[NDArray[np.complex128], NDArray[np.bool_]]:
    """What a morph carries: z of each triangle, (k, n-2), and whether ca and cb are propagation edges, (n-2, 2).

    Triangles stand in the order in which they are laid out, the root, which is closest to the centre, first.
    """
    T, tree = m.source, rooted(m.source, disk_center(m.source, m.target))
    slots = (tree.base[tree.order, None] + np.arange(3)) % 3
    points = m.at(np.asarray(times)) @ np.array([1, 1j])
    a, b, c = np.moveaxis(points[:, np.take_along_axis(T.triangles[tree.order], slots, axis=1)], 2, 0)
    return (c - a) / (b - a), np.take_along_axis(T.twin[tree.order], slots[:, [2, 1]], axis=1) >= 0


def over_base(m: Morph, times: ArrayLike) -> Floats:
    """Lengths of the propagation edges in proportion to the base of their triangle, (k, number of edges)."""
    z, propagates = take_apart(m, times)
    return np.concatenate([np.abs(z[:, propagates[:, 0]]), np.abs(1 - z[:, propagates[:, 1]])], axis=1)


def of_diagonals(m: Morph, times: ArrayLike) -> Floats:
    """Lengths of the diagonals, (k, n-3)."""
    ends = m.at(np.asarray(times))[:, m.source.diagonals]
    return np.asarray(np.hypot(*np.moveaxis(ends[:, :, 1] - ends[:, :, 0], 2, 0)))


def beyond(x: Floats) -> tuple[Floats, Floats]:
    """By what factors columns exceed the larger of their two ends, and fall below the smaller; 1 at least."""
    return x.max(axis=0) / np.maximum(x[0], x[-1]), np.minimum(x[0], x[-1]) / x.min(axis=0)


def shrinkage(m: Morph, times: ArrayLike) -> Floats:
    """How many times shorter each diagonal is than at both ends of the morph, (k, n-3); at least 1."""
    lengths = of_diagonals(m, [0.0, *np.asarray(times), 1.0])
    return np.maximum(1.0, np.minimum(lengths[0], lengths[-1]) / lengths[1:-1])


def shrinkage_by_depth(m: Morph, times: ArrayLike, parts: int = 4) -> pd.Series:
    """The median factor by which diagonals get shorter, by their distance from the root in parts of the tree."""
    depth = hops(m.source, disk_center(m.source, m.target))[m.source.dual].max(axis=1)
    return pd.Series(shrinkage(m, times).max(axis=0)).groupby(parts * depth // (depth.max() + 1)).median()
