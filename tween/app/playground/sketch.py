"""What a person does at a playground, without the browser: shapes drawn or chosen, a morph, files.

    wish -> Sketch.choose -> verdicts   options -> Sketch.move -> footage   file -> Sketch.take   Sketch.save -> file

All goes in and comes out as plain dictionaries, which become JSON.  Errors come out as words.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tween.app.playground.fields import explained
from tween.app.playground.footage import footage
from tween.app.playground.hand_drawn import Shape, judge
from tween.app.playground.wishes import HINT, granted, handed_in, in_words
from tween.errors import FileError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.io.frames import write_frames
from tween.io.writing import write_curve
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph
from tween.plot.animation import save_animation
from tween.triangulating.flips import remesh

OPTIONS: dict[str, Any] = {
    "path": "metric",
    "root": "disk-center",
    "triangulation": "matched",
    "guarantee": True,
    "seed": 0,
    "landmarks": [],
}
TRIANGULATIONS = {
    "matched": "matched",
    "remeshed": "remeshed (Delaunay)",
    "random": "random",
}
ROOTS = {
    "disk-center": "middle of the disk",
    "tree-center": "middle of the tree",
}
HELP = {
    "path": "How the triangles change; slide and linear are the paper's.",
    "triangles": "How the disks are cut into triangles: alike, as they match best; or each for itself, with flips.",
    "root": "The triangle from which the motion spreads, the dot in the middle field; click another one there.",
    "guarantee": "Whether angle budgets see to it that every shape bounds an immersed disk.",
}
KINDS = {
    "gif": ("animation, GIF", "tween_animation.gif"),
    "svg": ("animation, SVG", "tween_animation.svg"),
    "html": ("player, HTML", "tween_player.html"),
    "npz": ("frames, numpy", "tween_frames.npz"),
    "json": ("frames, JSON", "tween_frames.json"),
    "strip": ("frames side by side, SVG", "tween_frames.svg"),
    "csv": ("first curve, CSV", "tween_curve.csv"),
}


class Sketch:
    """Two shapes and a morph between them, as a person draws and chooses them.

    Parameters
    ----------
    given : Curve or array_like of shape (n, 2), optional
        A curve of one's own, chosen by the name "given".

    Attributes
    ----------
    curves : dict of str to Curve
        What was given, and what was handed in, by name.
    source, target : Shape
        What was drawn or chosen last.
    morph : Morph or None
        From one to the other; None where one of them bounds no disk.

    Examples
    --------
    >>> sketch = Sketch()
    >>> sketch.choose({"name": "loop"}, {"name": "disk"})["source"]["words"]
    'Bounds an immersed disk. 86 vertices, 4 crossings, 1.7 × 10³³ triangulations.'
    >>> sketch.move({"path": "metric"})["valid"]
    True
    """

    def __init__(self, given: Curve | ArrayLike | None = None) -> None:
        self.given = None if given is None else as_curve(given)
        self.curves = {} if self.given is None else {"given": self.given}
        self.source = self.target = Shape(None, None, HINT)
        self.morph: Morph | None = None

    def choose(self, source: Mapping[str, Any], target: Mapping[str, Any], brief: bool = False) -> dict[str, Any]:
        """Take the two shapes, and say whether they bound disks.

        Parameters
        ----------
        source, target : mapping
            See `.wishes`; the name "disk" is for the target only.
        brief : bool
            As in `.judge`.

        Returns
        -------
        dict
            source, target : dict
                ok : bool; words : the verdict; points : x, y, x, y, ...; triangles : a, b, c, a, ...; rows : where
                vertices were moved, their numbers before; why : see `.explained`.
        """
        self.morph = None
        self.source = granted(source, self.curves, brief)
        self.target = self._disk() if target.get("name") == "disk" else granted(target, self.curves, brief)
        return {"source": _seen(self.source), "target": _seen(self.target)}

    def take(self, name: str, data: bytes) -> tuple[list[str], str]:
        """Take a file that was handed in: its curves can be chosen by name from then on.

        Parameters
        ----------
        name : str
            Of the file.
        data : bytes

        Returns
        -------
        names : list of str
            Of its curves, of which none was taken before.
        notes : str
            What of the file is not used.

        Raises
        ------
        FileError, CurveError
            As `.handed_in`; nothing is taken then.
        """
        curves, notes = handed_in(name, data)
        names = []
        for wanted, curve in curves.items():
            number, free = 1, wanted
            while free in self.curves:
                number += 1
                free = f"{wanted} ({number})"
            self.curves[free] = curve
            names.append(free)
        return names, notes

    def move(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """Morph one shape into the other.

        Parameters
        ----------
        options : mapping
            Any of the keys of `OPTIONS`, whose values are the defaults.  Landmarks are pairs of vertices, which keep
            their numbers when others are moved.

        Returns
        -------
        dict
            See `footage`; without frames where there is no morph, and `words` says why.
        """
        self.morph = None
        shapes = self.source, self.target
        if any(shape.words == HINT for shape in shapes):
            return _nothing("Draw a closed curve on either side.") | {"waiting": True}
        if not all(shape.answer for shape in shapes):
            return _nothing("No morph: both curves have to bound a disk.")
        wanted = OPTIONS | dict(options)
        try:
            wanted["landmarks"] = [(_shown(self.source, i), _shown(self.target, j)) for i, j in wanted["landmarks"]]
            self.morph = self._morph(**wanted)
            return footage(self.morph, wanted["guarantee"], wanted["root"], wanted["landmarks"])
        except Exception as error:  # a person at a widget has no use for a traceback
            return _nothing(in_words(error))

    def save(self, kind: str, folder: str | os.PathLike[str] = ".") -> Path:
        """Write the morph, or the first curve, to a new file.

        Parameters
        ----------
        kind : str
            One of `KINDS`.
        folder : path

        Returns
        -------
        Path
            No file that is there already: a number is added to its name.

        Raises
        ------
        FileError
            Where there is nothing to save, or no such kind, or the file cannot be written.
        """
        if kind not in KINDS:
            raise FileError(f"there is no kind of file {kind!r}; expected one of {', '.join(KINDS)}")
        path = _unused(Path(folder) / KINDS[kind][1])
        if kind == "csv":
            if self.source.curve is None:
                raise FileError("there is no curve to save yet")
            write_curve(path, self.source.curve)
        elif self.morph is None:
            raise FileError("there is no morph to save yet")
        elif kind in ("gif", "svg", "html"):
            save_animation(path, self.morph, size=360)
        else:
            write_frames(path, self.morph, frames=9 if kind == "strip" else 60)
        return path

    def _disk(self) -> Shape:
        """The disk that the source becomes; nothing where the source bounds none."""
        if not self.source.answer:
            return Shape(None, None, "A disk, once the first curve bounds one.")
        disk = _triangulated(self.source, None).on_disk()
        return judge(disk.curve)._replace(words="A disk of the same area.", disk=True)

    def _morph(self, triangulation: str, seed: int, landmarks: list[tuple[int, int]], **options: Any) -> Morph:
        if triangulation not in TRIANGULATIONS:
            raise ValueError(f"triangulation is {triangulation!r}, expected one of {', '.join(TRIANGULATIONS)}")
        if landmarks and triangulation != "matched":
            raise ValueError(f"landmarks are for triangles that are matched, but those are {triangulation}")
        rng = np.random.default_rng(seed) if triangulation == "random" else None
        first = _triangulated(self.source, rng)
        if self.target.disk and not landmarks:
            return morph(first, first.on_disk(), **options)
        second = _triangulated(self.target, rng)
        second = second.moved(second.points * self._scale(first, second))
        if triangulation == "matched":
            return morph(first.curve, second.curve, landmarks=landmarks or None, **options)
        return morph(first, second, strategy="paper", **options)

    def _scale(self, first: Triangulation, second: Triangulation) -> float:
        """A power of two, which rounds nothing, by which the second becomes about as large as the first."""
        both_drawn = self.source.drawn and self.target.drawn
        return 1.0 if both_drawn else float(2.0 ** np.rint(0.5 * np.log2(first.curve.area / second.curve.area)))


def _shown(shape: Shape, row: int) -> int:
    """The vertex that had a number before vertices were moved: a curve that turned clockwise is numbered anew."""
    if not shape.moved or shape.curve is None:
        return row
    found = np.flatnonzero(shape.curve.origin == row)
    return int(found[0]) if len(found) else row


def _triangulated(shape: Shape, rng: np.random.Generator | None) -> Triangulation:
    """The remeshed triangulation, or one drawn at random."""
    assert shape.answer is not None
    return remesh(shape.answer.arbitrary()) if rng is None else shape.answer.sample(rng)


def _seen(shape: Shape) -> dict[str, Any]:
    """What a field shows of a shape."""
    points = shape.broken if shape.curve is None else shape.curve.points
    moved = shape.curve is not None and shape.moved
    return {
        "ok": bool(shape.answer),
        "words": shape.words,
        "points": [] if points is None else shape.placement.forth(points),
        "triangles": _triangulated(shape, None).triangles.ravel().tolist() if shape.answer else [],
        "rows": shape.curve.origin.tolist() if moved and shape.curve is not None else None,
        "why": explained(shape.explanation, shape.placement) if shape.explanation is not None else None,
    }


def _nothing(words: str) -> dict[str, Any]:
    return {"frames": [], "words": words, "valid": False}


def _unused(path: Path) -> Path:
    """The path, with a number where a file has that name already."""
    number = 1
    candidate = path
    while candidate.exists():
        number += 1
        candidate = path.with_stem(f"{path.stem}_{number}")
    return candidate
