"""What a person does at a playground, without the browser: shapes drawn or chosen, a morph, files.

    stroke or name -> Sketch.choose -> verdicts        options -> Sketch.move -> footage        Sketch.save -> file

All goes in and comes out as plain dictionaries, which become JSON.  Errors come out as words.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tween import gallery
from tween.app.playground.footage import fit, footage
from tween.app.playground.hand_drawn import Shape, from_stroke, judge
from tween.errors import FileError, TweenError
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
HINT = "Draw a closed curve here: press, go around, let go."


class Sketch:
    """Two shapes and a morph between them, as a person draws and chooses them.

    Parameters
    ----------
    given : Curve or array_like of shape (n, 2), optional
        A curve of one's own, chosen by the name "given".

    Attributes
    ----------
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
        self.source = self.target = Shape(None, None, HINT)
        self.morph: Morph | None = None

    def choose(self, source: Mapping[str, Any], target: Mapping[str, Any]) -> dict[str, Any]:
        """Take the two shapes, and say whether they bound disks.

        Parameters
        ----------
        source, target : mapping
            With a stroke, a list of places of the pointer; or with a name: one of `tween.gallery.names` or
            `tween.gallery.letters`, "given", "draw" for nothing yet, or "disk" for the target.

        Returns
        -------
        dict
            source, target : dict
                ok : bool; words : the verdict; points : x, y, x, y, ...; triangles : a, b, c, a, ...
        """
        self.morph = None
        self.source = self._shape(source)
        self.target = self._disk() if target.get("name") == "disk" else self._shape(target)
        return {"source": _seen(self.source), "target": _seen(self.target)}

    def move(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """Morph one shape into the other.

        Parameters
        ----------
        options : mapping
            Any of the keys of `OPTIONS`, whose values are the defaults.

        Returns
        -------
        dict
            See `footage`; without frames where there is no morph, and `words` says why.
        """
        self.morph = None
        for shape in (self.source, self.target):
            if not shape.answer:
                return _nothing(HINT if shape.curve is None else "No morph: both curves have to bound a disk.")
        wanted = OPTIONS | dict(options)
        try:
            self.morph = self._morph(**wanted)
            return footage(self.morph, wanted["guarantee"], wanted["root"])
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

    def _shape(self, wish: Mapping[str, Any]) -> Shape:
        try:
            if "stroke" in wish:
                return judge(from_stroke(wish["stroke"]), drawn=True)
            curve = _named(str(wish.get("name", "draw")), self.given)
            return Shape(None, None, HINT) if curve is None else judge(curve)
        except Exception as error:  # as above
            return Shape(None, None, in_words(error))

    def _disk(self) -> Shape:
        """The disk that the source becomes; nothing where the source bounds none."""
        if not self.source.answer:
            return Shape(None, None, "A disk, once the first curve bounds one.")
        disk = _triangulated(self.source, None).on_disk()
        return judge(disk.curve)._replace(words="A disk of the same area.", disk=True)

    def _morph(self, triangulation: str, seed: int, **options: Any) -> Morph:
        if triangulation not in TRIANGULATIONS:
            raise ValueError(f"triangulation is {triangulation!r}, expected one of {', '.join(TRIANGULATIONS)}")
        rng = np.random.default_rng(seed) if triangulation == "random" else None
        first = _triangulated(self.source, rng)
        if self.target.disk:
            return morph(first, first.on_disk(), **options)
        second = _triangulated(self.target, rng)
        second = second.moved(second.points * self._scale(first, second))
        if triangulation == "matched":
            return morph(first.curve, second.curve, **options)
        return morph(first, second, strategy="paper", **options)

    def _scale(self, first: Triangulation, second: Triangulation) -> float:
        """A power of two, which rounds nothing, by which the second becomes about as large as the first."""
        both_drawn = self.source.drawn and self.target.drawn
        return 1.0 if both_drawn else float(2.0 ** np.rint(0.5 * np.log2(first.curve.area / second.curve.area)))


def _named(name: str, given: Curve | None) -> Curve | None:
    if name == "draw":
        return None
    if name == "given" and given is not None:
        return given
    return gallery.letter(name) if len(name) == 1 else gallery.curve(name)


def _triangulated(shape: Shape, rng: np.random.Generator | None) -> Triangulation:
    """The remeshed triangulation, or one drawn at random."""
    assert shape.answer is not None
    return remesh(shape.answer.arbitrary()) if rng is None else shape.answer.sample(rng)


def _seen(shape: Shape) -> dict[str, Any]:
    """What a field shows of a shape."""
    if shape.curve is None:
        return {"ok": False, "words": shape.words, "points": [], "triangles": []}
    points = shape.curve.points
    return {
        "ok": bool(shape.answer),
        "words": shape.words,
        "points": np.rint(points).astype(int).ravel().tolist() if shape.drawn else fit(points),
        "triangles": _triangulated(shape, None).triangles.ravel().tolist() if shape.answer else [],
    }


def _nothing(words: str) -> dict[str, Any]:
    return {"frames": [], "words": words, "valid": False}


def in_words(error: Exception) -> str:
    """Say what to tell a person about an error.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    str

    Examples
    --------
    >>> in_words(FileError("there is no morph to save yet")), in_words(KeyError("kind"))
    ('there is no morph to save yet', "KeyError: 'kind'")
    """
    return str(error) if isinstance(error, TweenError | ValueError) else f"{type(error).__name__}: {error}"


def _unused(path: Path) -> Path:
    """The path, with a number where a file has that name already."""
    number = 1
    candidate = path
    while candidate.exists():
        number += 1
        candidate = path.with_stem(f"{path.stem}_{number}")
    return candidate
