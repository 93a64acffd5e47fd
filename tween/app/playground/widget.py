"""A playground: draw a curve by hand, see whether it bounds an immersed disk, morph it, take it with you.

A widget where there is a front end to show it, a picture elsewhere.  What it does is in `.sketch`; its
face, in static/, computes nothing but where the pointer is.
"""

import importlib.util
import io
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike
from PIL import Image

from tween import gallery, plot
from tween.app.playground.hand_drawn import BOX
from tween.app.playground.sketch import HELP, KINDS, OPTIONS, ROOTS, TRIANGULATIONS, Sketch, in_words
from tween.choices import PATHS
from tween.geometry.curve import Curve
from tween.plot import pixels
from tween.plot.film import record
from tween.plot.notebook import has_front_end

_STATIC = Path(__file__).with_name("static")
_FIRST = "loop"
_PICTURES, _SIZE = 5, 200  # of a morph, side by side, and how wide they are in pixels
_INSTRUCTIONS = (
    "There, draw a closed curve with the mouse, and it says whether the curve bounds an immersed disk, or why not; "
    "draw or choose where it is to go; move the slider; save the morph as an animation or as numbers."
)


def playground(curve: Curve | ArrayLike | None = None, live: bool | None = None) -> Any:
    """Show a playground: fields to draw in, verdicts, a morph to scrub, files to take away.

    Parameters
    ----------
    curve : Curve or array_like of shape (n, 2), optional
        To begin with; otherwise one of the gallery.
    live : bool, optional
        Whether to make a widget; by default where there is a front end, such as JupyterLab, to show it.

    Returns
    -------
    Playground or Picture
        A widget, or a picture with instructions where the packages of the extra "playground" are missing or nobody
        is there to use it.  The attribute `sketch` of both holds the curves and the morph, for the next cells.

    Examples
    --------
    >>> shown = playground(live=False)
    >>> print(shown)
    A picture in place of a playground; it needs ...
    >>> shown.sketch.morph
    Morph(86 vertices, 0 flips)
    """
    missing = [name for name in ("anywidget", "ipywidgets") if importlib.util.find_spec(name) is None]
    wanted = has_front_end() if live is None else live
    sketch = Sketch(curve)
    if wanted and not missing:
        return _widget()(sketch)
    return Picture(sketch, missing)


class Picture:
    """What a playground leaves where nobody can use it; made by `playground`.

    Parameters
    ----------
    sketch : Sketch
    missing : sequence of str
        Packages that are not there.

    Attributes
    ----------
    sketch : Sketch
        With the first curve on its way to the disk.
    """

    def __init__(self, sketch: Sketch, missing: Sequence[str] = ()) -> None:
        self.sketch = sketch
        self._missing = missing
        self._seen = sketch.choose({"name": _FIRST if sketch.given is None else "given"}, {"name": "disk"})
        self._film = sketch.move(OPTIONS)

    def __repr__(self) -> str:
        if self._missing:
            remedy = f"it needs {' and '.join(self._missing)}: pip install '.[playground]' in the project's folder"
        else:
            remedy = "it needs a front end: open the notebook in JupyterLab, and run the cell"
        return (
            f"A picture in place of a playground; {remedy}.\n{_INSTRUCTIONS}\n"
            f"Meanwhile, the curve: {self._seen['source']['words']}\nTo the disk: {self._film['words']}"
        )

    def _repr_png_(self) -> bytes | None:
        """The morph, side by side, from left to right."""
        if self.sketch.morph is None:
            return None
        shown = record(self.sketch.morph, frames=_PICTURES, size=(_SIZE, _SIZE), ease=False)
        strip = Image.new("RGB", (_PICTURES * _SIZE, _SIZE), "white")
        for k in range(_PICTURES):
            strip.paste(pixels.picture(shown, k), (k * _SIZE, 0))
        stream = io.BytesIO()
        strip.save(stream, format="PNG")
        return stream.getvalue()


@cache
def _widget() -> Any:
    """Make the class of the widget; only here its packages are needed."""
    import anywidget
    import traitlets

    class Playground(anywidget.AnyWidget):
        _esm = _face("playground.js", "drawing.js")
        _css = _face("playground.css")
        setup = traitlets.Dict().tag(sync=True)
        # From the browser.  Each says all that there is to say, so that none may be lost when they come fast.
        source = traitlets.Dict().tag(sync=True)
        target = traitlets.Dict().tag(sync=True)
        options = traitlets.Dict().tag(sync=True)
        wish = traitlets.Dict().tag(sync=True)
        # To the browser.
        shapes = traitlets.Dict().tag(sync=True)
        footage = traitlets.Dict().tag(sync=True)
        file = traitlets.Dict().tag(sync=True)

        def __init__(self, sketch: Sketch) -> None:
            first = "given" if sketch.given else _FIRST
            super().__init__(
                setup=_setup(sketch), source={"name": first}, target={"name": "disk"}, options=OPTIONS | {"asked": 0}
            )
            self.sketch = sketch
            self._answered: Any = (None, None)
            self._answer()
            self.observe(self._answer, names=["source", "target", "options"])
            self.observe(self._keep, names=["wish"])

        def _answer(self, _: Any = None) -> None:
            """The verdicts go ahead of the morph, which may take a moment; the number asked with goes back."""
            wish = (self.source, self.target), self.options
            if wish == self._answered:
                return
            if wish[0] != self._answered[0]:
                self.shapes = self.sketch.choose(self.source, self.target)
            self._answered = wish
            options = dict(self.options)
            asked = options.pop("asked", 0)
            self.footage = self.sketch.move(options) | {"asked": asked}

        def _keep(self, _: Any) -> None:
            self.file = _kept(self.sketch, self.wish) | {"asked": self.wish.get("asked", 0)}

        def __repr__(self) -> str:
            return f"A playground, alive in JupyterLab.\n{_INSTRUCTIONS}"

    return Playground


def _face(*names: str) -> str:
    """The text of files of the folder static, one after the other."""
    return "\n".join((_STATIC / name).read_text(encoding="utf-8") for name in names)


def _setup(sketch: Sketch) -> dict[str, Any]:
    """What the browser has to know once: what can be chosen, and the colours of the figures."""
    return {
        "box": BOX,
        "given": sketch.given is not None,
        "curves": [[name, gallery.describe(name)] for name in gallery.names()],
        "letters": list(gallery.letters()),
        "help": HELP,
        "paths": [[path] for path in PATHS],
        "roots": list(ROOTS.items()),
        "triangulations": list(TRIANGULATIONS.items()),
        "kinds": [[kind, words] for kind, (words, _) in KINDS.items()],
        "colors": {"source": plot.SOURCE, "target": plot.TARGET, "pivot": plot.PIVOT, "failure": plot.FAILURE},
    }


def _kept(sketch: Sketch, wish: Mapping[str, Any]) -> dict[str, Any]:
    """Save what is wished for in the current folder, or hand it to the browser; say how that went."""
    try:
        if wish.get("where") == "browser":
            with tempfile.TemporaryDirectory() as folder:
                path = sketch.save(wish["kind"], folder)
                return {"name": path.name, "data": path.read_bytes(), "words": f"Downloaded {path.name}."}
        path = sketch.save(wish["kind"])
        size = max(1, round(path.stat().st_size / 1000))
        return {"name": path.name, "words": f"Saved {path.name}, {size} kB, in the current folder."}
    except Exception as error:  # a person at a widget has no use for a traceback
        return {"name": "", "words": f"Not saved: {in_words(error)}"}
