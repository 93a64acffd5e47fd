r"""Closing a loop: the bridge from the last keyframe to the first, for threads that are there already.

Matched leg by leg, a loop of keyframes does not close: a vertex led once around by the matches comes back beside
itself.  So one leg is not matched but *closed*: the threads of the vertices of its two keyframes, as the other legs
lead them, are its nodes, and what is looked for is a common triangulation of those, the least distorting one.  Where
there is none, each keyframe gets triangles of its own, and flips do the rest.

Several nodes may lie on one edge.  Rounding may make a triangle of them, of no height; such triangles are priced out.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from tween.errors import TweenError
from tween.geometry.triangulation import Triangulation
from tween.morphing.keyframes.keyframe import Bridge
from tween.morphing.keyframes.subdivision import subdivided
from tween.morphing.keyframes.threads import Threads
from tween.morphing.matching.match import energy, is_valid
from tween.triangulating.costs import distortion
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh

_FLAT = 1e-7  # height over the longest edge, as a share of it
_PRICE = 1e6  # of a flat triangle; whatever costs so much is no answer

_MOST_VERTICES = 700
"""For a joint table."""

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


def closed(
    threads: Threads, disks: tuple[Triangulation, Triangulation], alone: tuple[bool, bool]
) -> tuple[Bridge, _Ints]:
    """Make the bridge from the last keyframe back to the first.

    Parameters
    ----------
    threads : Threads
        Through all keyframes.
    disks : (Triangulation, Triangulation)
        Those that are meant, of the last keyframe and of the first.
    alone : (bool, bool)
        Whether either is the only one that its curve bounds.

    Returns
    -------
    Bridge
    nodes : ndarray of int, shape (m,)
        The thread of each of its nodes.
    """
    ends = len(threads.keyframes) - 1, 0
    places = threads.places[:, ends]
    nodes = np.flatnonzero((places == np.floor(places)).any(axis=1))
    own = [_own(threads, i, T, nodes) for i, T in zip(ends, disks, strict=True)]
    shared = _shared(own, alone)
    first, last = (shared, shared) if shared is not None else (own[0].triangles, own[1].triangles)
    least = energy(*(Triangulation(T.points, shared) for T in own)) if shared is not None else np.inf
    return Bridge(places[nodes, 0], places[nodes, 1], own[0].points, own[1].points, first, last, least), nodes


def _own(threads: Threads, i: int, T: Triangulation, nodes: _Ints) -> Triangulation:
    """The disk of a keyframe with the nodes on its edges."""
    place = threads.places[nodes, i] % len(T)
    vertices = np.empty(len(T), np.int64)
    whole = place == np.floor(place)
    vertices[place[whole].astype(np.int64)] = np.flatnonzero(whole)
    split = Triangulation(threads.points[nodes, i], subdivided(T.triangles, vertices, len(nodes)))
    try:
        return remesh(split.validate())
    except TweenError:
        return split


def _shared(own: list[Triangulation], alone: tuple[bool, bool]) -> _Ints | None:
    """The least distorting triangulation that is valid in both, and of the disks that are meant; None for none."""
    if len(own[0]) > _MOST_VERTICES:
        return None
    try:
        both = decompose(own[0].curve, own[1].curve)
    except TweenError:  # nodes that rounding has put out of order make no curve
        return None
    if not both:
        return None
    found = both.optimal(_price(own[0].points, own[1].points))
    shapes = found, Triangulation(own[1].points, found.triangles)
    if not is_valid(*shapes) or not energy(*shapes) < _PRICE or any(_flat(T.points, T.triangles).any() for T in shapes):
        return None
    for T, meant, only in zip(shapes, own, alone, strict=True):
        if not only and not np.array_equal(remesh(T).canonical, remesh(meant).canonical):
            return None
    return np.asarray(found.triangles)


def _price(source: _Floats, target: _Floats) -> Callable[[_Ints], _Floats]:
    """The cost of triangles: their distortion, and much more for flat ones."""
    energies = distortion(source, target)

    def cost(triangles: _Ints) -> _Floats:
        flat = _flat(source, triangles) | _flat(target, triangles)
        return np.where(flat, _PRICE, np.minimum(energies(triangles), _PRICE))

    return cost


def _flat(points: _Floats, triangles: _Ints) -> NDArray[np.bool_]:
    """Whether triangles have hardly any height."""
    corners = points[triangles]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    twice = np.abs(u[:, 0, 0] * v[:, 0, 1] - u[:, 0, 1] * v[:, 0, 0])
    return np.asarray(twice < _FLAT * (u**2).sum(axis=2).max(axis=1))
