"""The loops of a curve: the two at each place where it meets itself, and those into which it falls apart.

Edges i < j meet at a point c.  The curve leads from c along edge i, over the vertices i+1, ..., j, back to c: the
*inner* loop; and on along edge j, over j+1, ..., n-1, 0, ..., i: the *outer* one.  Either may be cut off.

                     i+1  ...
                     /       \
        ---- i ---- c ----    :
                   / `--- j --'
                 j+1
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.geometry.crossings import Crossings
from tween.geometry.curve import Curve
from tween.triangulating.repair.pieces import tidied

_Floats = NDArray[np.float64]


class Meetings(NamedTuple):
    """Where edges of a curve meet.

    Attributes
    ----------
    pairs : ndarray of int, shape (k, 2)
        Edges i < j.
    places : ndarray of float64, shape (k, 2)
        The point c, up to rounding; for edges that only touch, a vertex.
    areas : ndarray of float64, shape (k, 2)
        Signed areas of the inner and of the outer loop.
    """

    pairs: NDArray[np.intp]
    places: _Floats
    areas: _Floats

    def __len__(self) -> int:
        return len(self.pairs)


def meetings(curve: Curve) -> Meetings:
    """Find where a curve meets itself, and how large the loops there are.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    Meetings

    Examples
    --------
    >>> meetings(Curve([[0, 0], [2, 2], [2, 0], [0, 2]])).areas.tolist()
    [[-1.0, 1.0]]
    """
    crossings, p = curve.crossings, curve.points
    places = np.where(crossings.proper[:, None], _crossing_places(p, crossings), _touching_places(p, crossings))
    i, j = crossings.pairs.T
    origin = p[0]
    sums = np.append(0.0, np.cumsum(_cross(p - origin, np.roll(p, -1, axis=0) - origin)))
    c = places - origin
    inner = sums[j] - sums[i + 1] + _cross(c, p[i + 1] - origin) + _cross(p[j] - origin, c)
    return Meetings(crossings.pairs, places, np.stack([inner, sums[-1] - inner], axis=1) / 2)


def _cross(a: _Floats, b: _Floats) -> _Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _crossing_places(p: _Floats, crossings: Crossings) -> _Floats:
    """The points at which the lines of two edges meet; within both edges, whatever rounding does."""
    (i, j), n = crossings.pairs.T, len(p)
    a, u, v = p[i], p[(i + 1) % n] - p[i], p[(j + 1) % n] - p[j]
    det = _cross(u, v)
    share = np.clip(_cross(p[j] - a, v) / np.where(det == 0, 1.0, det), 0.0, 1.0)
    found = a + share[:, None] * u
    low, high = np.minimum(p[j], p[(j + 1) % n]), np.maximum(p[j], p[(j + 1) % n])
    return np.asarray(np.clip(found, low, high))


def _touching_places(p: _Floats, crossings: Crossings) -> _Floats:
    """Of the four ends of two edges the one that is nearest to the other edge."""
    (i, j), n = crossings.pairs.T, len(p)
    a, b, c, d = p[i], p[(i + 1) % n], p[j], p[(j + 1) % n]
    ends = np.stack([a, b, c, d], axis=1)
    off = np.stack([_off(a, c, d), _off(b, c, d), _off(c, a, b), _off(d, a, b)], axis=1)
    return np.asarray(np.take_along_axis(ends, off.argmin(axis=1)[:, None, None], axis=1)[:, 0])


def _off(q: _Floats, a: _Floats, b: _Floats) -> _Floats:
    """Distance of q from the segment ab."""
    along = b - a
    share = np.clip(((q - a) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return np.asarray(np.hypot(*(a + share[:, None] * along - q).T))


def split(points: _Floats, pair: tuple[int, int], place: _Floats) -> tuple[_Floats, _Floats]:
    """Take a closed polygon apart where two edges meet.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
    pair : tuple of int
        Edges i < j.
    place : ndarray of float64, shape (2,)
        Where they meet.

    Returns
    -------
    inner, outer : ndarray of float64, shape (m, 2)
        The two loops, without repeated points and exact spikes; of fewer than three points where nothing is left.

    Examples
    --------
    >>> bow = np.array([[0.0, 0], [2, 2], [2, 0], [0, 2]])
    >>> split(bow, (0, 2), np.array([1.0, 1]))[0].tolist()
    [[1.0, 1.0], [2.0, 2.0], [2.0, 0.0]]
    """
    i, j = pair
    inner = np.concatenate([place[None], points[i + 1 : j + 1]])
    outer = np.concatenate([points[: i + 1], place[None], points[j + 1 :]])
    return inner[tidied(inner)], outer[tidied(outer)]


def simple_loops(curve: Curve, at: Meetings) -> list[_Floats]:
    """Let a curve fall apart at all its crossings at once, into loops that do not cross.

    Parameters
    ----------
    curve : Curve
        One that only crosses itself properly.
    at : Meetings
        Its crossings.

    Returns
    -------
    list of ndarray of float64, shape (m, 2)
        At each crossing the curve turns off into the other strand instead of going straight on.  Loops that run
        counter-clockwise less those that run clockwise are the turning number, if crossings could be put into order
        along the edges; otherwise there is no loop in the list.

    References
    ----------
    H. Seifert, *Über das Geschlecht von Knoten*, Mathematische Annalen 110 (1935) 571-592: such loops of a knot.
    """
    p, k = curve.points, len(at)
    if not k:
        return [p]
    edge = at.pairs.T.ravel()  # visits 0..k-1 are on edges i, visits k..2k-1 on edges j
    off = np.hypot(*(np.tile(at.places, (2, 1)) - p[edge]).T)
    order = np.lexsort((off, edge))
    following = np.empty(2 * k, dtype=np.intp)
    following[order] = np.roll(order, -1)
    unseen, loops = np.ones(2 * k, dtype=np.bool_), []
    for start in range(2 * k):
        pieces, visit = [], start
        while unseen[visit]:
            unseen[visit] = False
            leaving = (visit + k) % (2 * k)
            visit = int(following[leaving])
            pieces.append(
                _along(p, at.places[leaving % k], int(edge[leaving]), int(edge[visit]), off[leaving] < off[visit])
            )
        if pieces:
            loops.append(np.concatenate(pieces))
    signs = sum(1 if signed_area(loop) > 0 else -1 for loop in loops)
    return loops if signs == curve.turning_number else []


def _along(p: _Floats, place: _Floats, edge: int, until: int, ahead: bool) -> _Floats:
    """A place on an edge, and the vertices from there on to another edge."""
    steps = (until - edge) % len(p) if edge != until else 0 if ahead else len(p)
    return np.concatenate([place[None], p[np.arange(edge + 1, edge + 1 + steps) % len(p)]])


def signed_area(points: _Floats) -> float:
    """Signed area of a closed polygon.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    float
        More than 0 where a simple polygon is counter-clockwise.
    """
    x = points - points[0]
    return 0.5 * float(_cross(x, np.roll(x, -1, axis=0)).sum())
