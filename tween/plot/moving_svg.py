"""Films as text: an SVG that moves by itself, and a page with a player.

The longer side of the canvas has 5000 units and coordinates are whole numbers of them: four significant digits.
One path for each triangle and one for the outline go through all frames, and a browser interpolates between
these; the corner that a flip moves slides to its new vertex from one frame to the next.
"""

import json
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from string import Template

import numpy as np
from numpy.typing import NDArray

from tween.plot.film import OPACITY, Film

_UNITS = 5000
_PLAYER = Path(__file__).with_name("player.html")


def svg(film: Film) -> str:
    """Write a film as an SVG that plays by itself, endlessly, also where it is shown as an image.

    Parameters
    ----------
    film : Film

    Returns
    -------
    str
        Animated by SMIL, which all browsers play; a program that does not shows the source.

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> from tween.plot.film import record
    >>> T = triangulate(gallery.curve("ess"))
    >>> text = svg(record(morph(T, T.on_disk()), frames=5, style="fill"))
    >>> len(T.triangles), text.count("<path"), text.count("<animate ")
    (92, 93, 94)
    """
    numbers, timing = _timing(film)
    outline, triangles = _polygons(film)

    def animation(attribute: str, values: list[str]) -> str:
        return f'<animate attributeName="{attribute}" {timing} values="{";".join(values[k] for k in numbers)}"/>'

    def through(polygons: NDArray[np.int64]) -> str:
        paths = [_path(polygon) for polygon in polygons.tolist()]
        return f'd="{paths[0]}">{animation("d", paths)}</path>'

    tint = animation("stroke" if film.style == "outline" else "fill", [_hex(color) for color in film.tints])
    return _drawing(film, through(outline), [through(row) for row in triangles], tint)


def player(film: Film) -> str:
    """Write a film as a page with a button to play and pause it and a slider; it needs nothing but itself.

    Parameters
    ----------
    film : Film

    Returns
    -------
    str
        HTML.

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> from tween.plot.film import record
    >>> T = triangulate(gallery.curve("ess"))
    >>> "<script>" in player(record(morph(T, T.on_disk()), frames=5))
    True
    """
    outline, triangles = _polygons(film)
    still = [f'd="{_path(row[0].tolist())}"/>' for row in (outline, *triangles)]
    data = {
        "fps": film.fps,
        "hold": film.hold,
        "there_and_back": film.there_and_back,
        "times": film.times.round(6).tolist(),
        "flips": film.flips.tolist(),
        "tint": {"triangles": "", "outline": "stroke", "fill": "fill"}[film.style],
        "tints": film.tints.tolist(),
        "shapes": outline.reshape(len(outline), -1).tolist(),
        "rows": _changes(film) if film.style != "outline" else [[] for _ in film.times],
    }
    return Template(_PLAYER.read_text(encoding="utf-8")).substitute(
        title=_title(film),
        background=_hex(film.background),
        ink=_hex(film.ink),
        accent=_hex(film.edge),
        width=film.width,
        last=len(film.times) - 1,
        svg=_drawing(film, still[0], still[1:]),
        data=json.dumps(data, separators=(",", ":")),
    )


def _drawing(film: Film, outline: str, triangles: list[str], tint: str = "") -> str:
    """The SVG, from what follows the colour of each path; ``tint`` animates the colour of the whole shape."""
    unit = _UNITS / max(film.width, film.height)
    width, first = round(film.line * unit), _hex(film.tints[0])
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{film.width}" height="{film.height}"'
        f' viewBox="0 0 {round(film.width * unit)} {round(film.height * unit)}" stroke-linejoin="round">'
    )
    lines = [head, f"<title>{_title(film)}</title>"]
    lines.append(f'<rect width="100%" height="100%" fill="{_hex(film.background)}"/>')
    if film.style == "triangles":
        edges = f'stroke="{_hex(film.edge)}" stroke-opacity="0.5" stroke-width="{round(0.45 * width)}"'
        fills = [f'<path fill="{_hex(color)}" ' for color in film.colors]
        lines.append(f'<g class="triangles" fill-opacity="{OPACITY}" {edges}>')
        lines += [fill + path for fill, path in zip(fills, triangles, strict=True)]
        lines.append("</g>")
    elif film.style == "fill":  # without smoothed edges, so that neighbours leave no seam
        lines.append(
            f'<g class="triangles" fill="{first}" fill-opacity="{OPACITY}" shape-rendering="crispEdges">{tint}'
        )
        lines += ["<path " + path for path in triangles]
        lines.append("</g>")
    color, tint = (first, tint) if film.style == "outline" else (_hex(film.ink), "")
    lines.append(f'<g class="outline" fill="none" stroke="{color}" stroke-width="{width}">{tint}<path {outline}</g>')
    return "\n".join([*lines, "</svg>\n"])


def _polygons(film: Film) -> tuple[NDArray[np.int64], list[NDArray[np.int64]]]:
    """In units of the drawing, the outline in all frames, shape (k, n, 2), and each triangle, shape (k, 3, 2)."""
    outline = np.rint(film.shapes * (_UNITS / max(film.width, film.height))).astype(np.int64)
    if film.style == "outline":
        return outline, []
    frames = np.arange(len(outline))[:, None]
    return outline, [outline[frames, row] for row in film.triangles.swapaxes(0, 1)]


def _timing(film: Film) -> tuple[list[int], str]:
    """The frames in order, one that rests named twice, and the attributes that say when each is reached."""
    starts = np.concatenate([[0.0], np.cumsum(film.seconds)])
    total = starts[-1]
    numbers, times = [], []
    for number, start, end in zip(film.numbers.tolist(), starts[:-1], starts[1:], strict=True):
        leaves = end if end == total else end - 1 / film.fps
        kept = 2 if leaves - start > 1e-6 else 1
        numbers += [number] * kept
        times += [start, leaves][:kept]
    keys = ";".join(f"{time / total:.4f}".rstrip("0").rstrip(".") for time in times)
    return numbers, f'dur="{total:.6g}s" repeatCount="indefinite" keyTimes="{keys}"'


def _path(points: list[list[int]]) -> str:
    """A closed path, from a place on by steps."""
    (x, y), *_ = points
    steps = [f"{c - a} {d - b}" for (a, b), (c, d) in pairwise(points)]
    return f"M{x} {y}l{' '.join(steps)}z".replace(" -", "-")


def _changes(film: Film) -> list[list[int]]:
    """For each frame the rows that are not as in the frame before, and their corners, in one list."""
    lists = film.triangles
    new = np.concatenate([[np.ones(lists.shape[1], dtype=np.bool_)], (lists[1:] != lists[:-1]).any(axis=2)])
    rows = np.broadcast_to(np.arange(lists.shape[1])[:, None], (*lists.shape[:2], 1))
    return [
        entries[now].ravel().tolist() for entries, now in zip(np.concatenate([rows, lists], axis=2), new, strict=True)
    ]


def _title(film: Film) -> str:
    return f"Morph of {film.shapes.shape[1]} vertices, {film.flips[-1]} flips"


def _hex(color: Iterable[int]) -> str:
    return "#" + "".join(f"{value:02x}" for value in color)
