"""Morphs in numbers that a browser can draw: shapes, areas, sums of angles, and what is certified.

Shapes are placed in a field, see `.fields`; those of a morph all at one scale.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tween.app.playground.fields import fitting
from tween.geometry.dual_tree import along_longest_path
from tween.geometry.triangulation import Triangulation
from tween.measuring.certificate import Certificate, certify
from tween.measuring.metrics import angle_sums, area_matrix, area_rank
from tween.morphing.compatible.leg import root_triangle
from tween.morphing.morph import Morph
from tween.plot.shapes import identity_colors
from tween.plural import counted

FRAMES = 81


def footage(
    m: Morph, guarantee: bool = False, root: str | int = "disk-center", landmarks: Sequence[tuple[int, int]] = ()
) -> dict[str, Any]:
    """Describe a morph in numbers that a browser can draw.

    Parameters
    ----------
    m : Morph
    guarantee : bool
        Whether it was made with one, so that none is recommended.
    root : str or int
        The one that it was made with.
    landmarks : sequence of (int, int)
        Those that it was made with.

    Returns
    -------
    dict
        frames : 81 lists x, y, x, y, ..., at one scale; stages : the lists of triangles in
        force, a, b, c, a, ...; stage : which of them, for each frame; areas : for each frame, of each triangle, in
        10000ths of the source; sums, worst : for each frame, the largest sum of angles, in radians, and its vertex;
        colors, order : of each triangle, and of all along the disk; root : a triangle, or -1; marks : the vertex
        of each landmark; words, valid : what `.certify` says.

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> seen = footage(morph(T, T.on_disk()))
    >>> len(seen["frames"]), seen["valid"], seen["worst"][0], sum(seen["areas"][0])
    (81, True, 3, 10000)
    """
    times = np.linspace(0, 1, FRAMES)
    _, first, stage = np.unique(m.stage_at(times), return_index=True, return_inverse=True)
    sums = angle_sums(m, times)
    certificate = certify(m, FRAMES)
    colors = np.rint(255 * identity_colors(m.source)[:, :3]).astype(np.uint8)
    shapes = m.at(times)
    place = fitting(shapes)
    return {
        "frames": [place.forth(shape) for shape in shapes],
        "stages": [m.triangles_at(float(times[f])).ravel().tolist() for f in first],
        "stage": stage.tolist(),
        "areas": np.rint(1e4 * area_matrix(m, FRAMES).T).astype(int).tolist(),
        "sums": sums.max(axis=0).round(4).tolist(),
        "worst": sums.argmax(axis=0).tolist(),
        "colors": ["#" + bytes(color).hex() for color in colors],
        "order": _along(m.source),
        "root": _root(m, root),
        "marks": _marks(m, landmarks),
        "valid": certificate.valid,
        "words": _promise(m, certificate, guarantee),
    }


def _along(T: Triangulation) -> list[int]:
    """The triangles in the order of `identity_colors`: along the longest path of the dual tree."""
    return np.argsort(along_longest_path(T), kind="stable").tolist()


def _marks(m: Morph, landmarks: Sequence[tuple[int, int]]) -> list[int]:
    """The vertex of the morph that each landmark has become."""
    return [int(np.flatnonzero(m.source_vertices == i)[0]) for i, _ in landmarks]


def _root(m: Morph, root: str | int) -> int:
    """The triangle from which the motion spreads; -1 where there are two, one on each side of the flips."""
    if isinstance(root, str) and m.events:
        return -1
    return root_triangle(root, m.source, m.source.moved(m.target.points))


def _promise(m: Morph, certificate: Certificate, guarantee: bool) -> str:
    """What is known about the shapes on the way, in plain words."""
    failure = certificate.first_failure
    if failure:
        advice = "" if guarantee else " With the guarantee it would not."
        rule = failure.rule.partition(":")[0]
        return f"Bounds no disk at t = {failure.t:.3f}: {rule}.{advice}"
    between = "and between them every instant of playback"
    flips = counted(len(m.events), "flip").capitalize()
    rank = area_rank(area_matrix(m, FRAMES), rtol=1e-4)
    checked = f"Every shape bounds a disk: {certificate.frames_checked} were checked exactly, {between}."
    return f"{checked} {flips}; area rank {rank} at 1e-4."
