"""Frames of a film as pictures in pixels.

Every edge of a triangle adds the triangle's colour to all pixels to its right in the rows that it crosses, or takes
it away, depending on its direction; running sums along the rows leave it inside only.  So triangles that share an
edge leave no seam, and neither their order nor that of the layers of a disk matters: where layers overlap, the
picture is darker and shows the mean of their colours.
"""

from math import ceil

import numpy as np
from numba import njit
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from tween.plot.film import Film
from tween.plot.look import Color

_FINE, _FINEST = 2, 4  # samples of a pixel's side, of areas and of lines
_MOST_LAYERS = 16  # told apart
_EDGE_WIDTH, _EDGE_OPACITY = 0.45, 0.5  # as a share of the outline's width


def picture(film: Film, k: int) -> Image.Image:
    """Draw one shape of a film.

    Parameters
    ----------
    film : Film
    k : int
        Number of the shape.

    Returns
    -------
    Image
        In the mode "RGB"; of a transparent film "RGBA".

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> from tween.plot.film import record
    >>> T = triangulate(gallery.curve("ess"))
    >>> picture(record(morph(T, T.on_disk()), size=(80, 60)), 0).size
    (80, 60)
    """
    if not film.transparent:
        return _drawn(film, k, film.background)
    on_black, on_white = (np.asarray(_drawn(film, k, (v, v, v)), dtype=np.float64) for v in (0, 255))
    # What is seen on both is c a, and c a + 255 (1 - a).
    alpha = 1 - (on_white - on_black).mean(axis=2) / 255
    color = np.where(alpha[..., None] > 0, on_black / np.maximum(alpha, 1e-9)[..., None], 0.0)
    return Image.fromarray(np.rint(np.clip(np.dstack([color, 255 * alpha]), 0, 255)).astype(np.uint8))


def _drawn(film: Film, k: int, background: Color) -> Image.Image:
    points, triangles = film.shapes[k], film.triangles[k]
    image = Image.new("RGB", (film.width, film.height), background)
    bare = np.power(1 - film.opacity, np.arange(_MOST_LAYERS, dtype=np.float64))
    if film.style == "triangles":
        image = _layered(image, points[triangles], film.colors, bare)
        edges = _lines(film, [points[edge] for edge in _diagonals(triangles)], _EDGE_WIDTH * (film.line or 1.0))
        image.paste(film.edge, mask=edges.point([round(_EDGE_OPACITY * share) for share in range(256)]))
    elif film.style == "fill":
        image = _layered(image, points[None], film.tints[k : k + 1], bare)
    if film.line:
        outline = film.ink if film.style != "outline" else tuple(film.tints[k].tolist())
        image.paste(outline, mask=_lines(film, [np.concatenate([points, points[:2]])], film.line))
    return image


def _layered(
    image: Image.Image, polygons: NDArray[np.float64], colors: NDArray[np.int64], bare: NDArray[np.float64]
) -> Image.Image:
    """The picture with transparent polygons, shape (p, q, 2), laid on it."""
    canvas = np.array(image, dtype=np.float64)
    _lay(canvas, polygons, colors, bare)
    return Image.fromarray(np.rint(canvas).astype(np.uint8))


def _diagonals(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """The edges that belong to two triangles, each once."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    return found[count == 2]


@njit(cache=True)
def _lay(canvas, polygons, colors, bare):
    """Lay polygons on a canvas of one colour; ``bare[c]`` is the share of it that shows through c layers."""
    background = canvas[0, 0].copy()
    # integers, so that what one triangle adds along an edge its neighbour takes away exactly
    # one column more, for what lies beyond the right border
    sums = np.zeros((canvas.shape[0] * _FINE, canvas.shape[1] * _FINE + 1, 4), np.int32)
    for p in range(polygons.shape[0]):
        for i in range(polygons.shape[1]):
            _add_edge(sums, _FINE * polygons[p, i - 1], _FINE * polygons[p, i], colors[p])
    inside = np.zeros(4, np.int64)
    for y in range(sums.shape[0]):
        inside[:] = 0
        for x in range(sums.shape[1] - 1):
            for channel in range(4):
                inside[channel] += sums[y, x, channel]
            layers = inside[0]
            if layers != 0:
                # polygons of one orientation count negative, and so do their colours: the quotient has no sign
                share = (1.0 - bare[min(abs(layers), len(bare) - 1)]) / _FINE**2
                for channel in range(3):
                    change = inside[1 + channel] / layers - background[channel]
                    canvas[y // _FINE, x // _FINE, channel] += share * change


@njit(cache=True, inline="always")
def _add_edge(sums, a, b, color):
    """Add the colour where the edge enters a polygon, or take it away where it leaves it, in the rows it crosses."""
    sign, top, bottom = (1, a, b) if b[1] > a[1] else (-1, b, a)
    slope = (bottom[0] - top[0]) / (bottom[1] - top[1]) if bottom[1] > top[1] else 0.0
    # rows whose middle lies from top to below bottom: edges that meet at a vertex share no row and leave none out
    for row in range(max(0, ceil(top[1] - 0.5)), min(sums.shape[0], ceil(bottom[1] - 0.5))):
        column = ceil(top[0] + slope * (row + 0.5 - top[1]) - 0.5)
        place = sums[row, min(max(column, 0), sums.shape[1] - 1)]
        place[0] += sign
        for channel in range(3):
            place[1 + channel] += sign * color[channel]


def _lines(film: Film, lines: list[NDArray[np.float64]], width: float) -> Image.Image:
    """How much of each pixel the lines cover, 0 to 255."""
    mask = Image.new("L", (film.width * _FINEST, film.height * _FINEST))
    pen = ImageDraw.Draw(mask)
    for line in lines:
        pen.line((line * _FINEST).ravel().tolist(), fill=255, width=round(width * _FINEST), joint="curve")
    return mask.reduce(_FINEST)
