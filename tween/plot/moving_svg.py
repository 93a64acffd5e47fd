"""Films as text: an SVG that moves by itself, and a page with a player.

The longer side of the canvas has 5000 units and coordinates are whole numbers of them: four significant digits.
Straight motion between the rounded outlines is verified; where rounding breaks it, they have units ten times as fine,
and so on. One path for each triangle and one for the outline go through all frames, and a browser interpolates
between these; the corner that a flip moves slides to its new vertex from one frame to the next.  The triangles in
force are written down beside the drawing, so that `tween.read_frames` gets back what is played, and `tween.verify`
can check it.
"""

import json
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from string import Template

import numpy as np
from numpy.typing import NDArray

from tween.io.formats.writers import changed_triangles
from tween.measuring.certificate import verify
from tween.plot.film import Film

_UNITS = 5000
_FINEST = 10**9  # times as fine: whole numbers that doubles still tell apart
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
    finer = _finer(film)
    # of an opaque disk all layers look alike, and its outline filled is the same picture
    opaque = film.style == "fill" and film.opacity == 1
    outline, triangles = _rounded(film, finer), [] if opaque else _triangles(film, _rounded(film))

    def animation(attribute: str, values: list[str]) -> str:
        return f'<animate attributeName="{attribute}" {timing} values="{";".join(values[k] for k in numbers)}"/>'

    def through(polygons: NDArray[np.int64]) -> str:
        paths = [_path(polygon) for polygon in polygons.tolist()]
        return f'd="{paths[0]}">{animation("d", paths)}</path>'

    tint = animation("stroke" if film.style == "outline" else "fill", [_hex(color) for color in film.tints])
    data = json.dumps({"frames": numbers, "triangles": changed_triangles(film.triangles)}, separators=(",", ":"))
    return _drawing(film, (1, finer), through(outline), [through(row) for row in triangles], tint, data)


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
    finer = _finer(film)
    outline = _rounded(film, finer)
    triangles = _triangles(film, outline)
    still = [f'd="{_path(row[0].tolist())}"/>' for row in (outline, *triangles)]
    data = {
        "fps": film.fps,
        "hold": film.hold,
        "way": film.way,
        "there_and_back": film.there_and_back,
        "clock": film.clock.round(9).tolist(),
        "times": film.times.round(6).tolist(),
        "flips": film.flips.tolist(),
        "tint": {"triangles": "", "outline": "stroke", "fill": "fill"}[film.style],
        "tints": film.tints.tolist(),
        "shapes": outline.reshape(len(outline), -1).tolist(),
        "rows": changed_triangles(film.triangles),
    }
    return Template(_PLAYER.read_text(encoding="utf-8")).substitute(
        title=_title(film),
        background="transparent" if film.transparent else _hex(film.background),
        ink=_hex(film.ink),
        accent=_hex(film.edge),
        width=film.width,
        last=len(film.times) - 1,
        svg=_drawing(film, (finer, finer), still[0], still[1:]),
        data=json.dumps(data, separators=(",", ":")),
    )


def _drawing(
    film: Film, finer: tuple[int, int], outline: str, triangles: list[str], tint: str = "", data: str = ""
) -> str:
    """The SVG, from what follows the colour of each path; ``tint`` animates the colour of the whole shape.

    By so much the units of the triangles, and those of the outline, are finer.
    """
    unit = _UNITS / max(film.width, film.height)
    width, first = round((film.line or 1.0) * unit), _hex(film.tints[0])
    scales = [f' transform="scale({1 / times:g})"' if times > 1 else "" for times in finer]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{film.width}" height="{film.height}"'
        f' viewBox="0 0 {round(film.width * unit)} {round(film.height * unit)}" stroke-linejoin="round">'
    )
    lines = [head, f"<title>{_title(film)}</title>"]
    if data:
        lines.append(f"<metadata>{data}</metadata>")
    if not film.transparent:
        lines.append(f'<rect width="100%" height="100%" fill="{_hex(film.background)}"/>')
    if film.style == "triangles":
        edges = f'stroke="{_hex(film.edge)}" stroke-opacity="0.5" stroke-width="{round(0.45 * width) * finer[0]}"'
        fills = [f'<path fill="{_hex(color)}" ' for color in film.colors]
        lines.append(f'<g class="triangles"{scales[0]} fill-opacity="{film.opacity:g}" {edges}>')
        lines += [fill + path for fill, path in zip(fills, triangles, strict=True)]
        lines.append("</g>")
    elif film.style == "fill" and triangles:  # without smoothed edges, so that neighbours leave no seam
        fill = f'fill="{first}" fill-opacity="{film.opacity:g}" shape-rendering="crispEdges"'
        lines.append(f'<g class="triangles"{scales[0]} {fill}>{tint}')
        lines += ["<path " + path for path in triangles]
        lines.append("</g>")
    color, tint = (first, tint) if film.style == "outline" else (_hex(film.ink), "")
    fill = first if film.style == "fill" and not triangles else "none"
    stroke = f'stroke="{color if film.line else "none"}" stroke-width="{width * finer[1]}"'
    lines.append(f'<g class="outline"{scales[1]} fill="{fill}" {stroke}>{tint}<path {outline}</g>')
    return "\n".join([*lines, "</svg>\n"])


def _finer(film: Film) -> int:
    """How much finer units have to be for rounded outlines to be verified; 1 where none will do."""
    finer = 1
    while finer <= _FINEST:
        if verify(_rounded(film, finer) * [1.0, -1.0], film.triangles, film.clock, between="linear"):
            return finer
        finer *= 10
    return 1


def _rounded(film: Film, finer: int = 1) -> NDArray[np.int64]:
    """The shapes in units of the drawing, or in finer ones."""
    return np.rint(film.shapes * (finer * _UNITS / max(film.width, film.height))).astype(np.int64)


def _triangles(film: Film, shapes: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Each triangle in all frames, shape (k, 3, 2); none where only the curve is drawn."""
    frames = np.arange(len(shapes))[:, None]
    return [] if film.style == "outline" else [shapes[frames, row] for row in film.triangles.swapaxes(0, 1)]


def _timing(film: Film) -> tuple[list[int], str]:
    """The frames in order, one that rests named twice, and the attributes that say when each is reached."""
    there, last = film.hold + film.way * film.clock, len(film.clock) - 1
    total = 2 * film.hold + film.way * (1 + film.there_and_back) + 1 / film.fps
    keys = [(0, 0.0), *enumerate(there.tolist())]
    if film.there_and_back:
        back = 2 * film.hold + film.way * (2 - film.clock)
        keys += [(last, film.hold + there[-1]), *((i, back[i]) for i in range(last - 1, -1, -1))]
    keys.append((keys[-1][0], total))
    before = [(-1, 0.0), *keys]
    kept = [key for key, old in zip(keys, before, strict=False) if key[0] != old[0] or key[1] - old[1] > 1e-6]
    digits = 4 if np.diff([time for _, time in kept]).min() > 1e-3 * total else 8
    times = ";".join(f"{time / total:.{digits}f}".rstrip("0").rstrip(".") for _, time in kept)
    return [number for number, _ in kept], f'dur="{total:.6g}s" repeatCount="indefinite" keyTimes="{times}"'


def _path(points: list[list[int]]) -> str:
    """A closed path, from a place on by steps."""
    (x, y), *_ = points
    steps = [f"{c - a} {d - b}" for (a, b), (c, d) in pairwise(points)]
    return f"M{x} {y}l{' '.join(steps)}z".replace(" -", "-")


def _title(film: Film) -> str:
    return f"Morph of {film.shapes.shape[1]} vertices, {film.flips[-1]} flips"


def _hex(color: Iterable[int]) -> str:
    return "#" + "".join(f"{value:02x}" for value in color)
