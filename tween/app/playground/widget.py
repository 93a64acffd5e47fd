"""A playground: draw a curve by hand, see whether it bounds an immersed disk, morph it, take it with you.

A widget where there is a front end to show it, a picture elsewhere.  What it does is in `.sketch`; its
face, in static/, computes nothing but where the pointer is.
"""

import importlib.util
import io
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike
from PIL import Image

from tween.app.playground.conversation import Conversation, setup
from tween.app.playground.sketch import OPTIONS, Sketch
from tween.geometry.curve import Curve
from tween.io.reading import read_curve
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


def on_page(path: str | None = None, folder: str | Path = ".") -> Any:
    """Show a playground on a page of its own, see `.page`: it is there before its first morph is.

    Parameters
    ----------
    path : str, optional
        A file with a curve to begin with.
    folder : path
        Where files are saved.

    Returns
    -------
    Playground
    """
    return _widget()(Sketch(None if path is None else read_curve(path)), folder, at_once=False)


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
        _esm = _face("playground.js", "layout.js", "fields.js", "drawing.js", "plots.js")
        _css = _face("playground.css")
        setup = traitlets.Dict().tag(sync=True)
        # From the browser.  Each says all that there is to say, so that none may be lost when they come fast.
        source, target, options, upload, wish = (traitlets.Dict().tag(sync=True) for _ in range(5))
        # To the browser.
        shapes, footage, uploads, file = (traitlets.Dict().tag(sync=True) for _ in range(4))

        def __init__(self, sketch: Sketch, folder: str | Path = ".", at_once: bool = True) -> None:
            first, options = {"name": "given" if sketch.given else _FIRST}, OPTIONS | {"asked": 0}
            super().__init__(setup=setup(sketch), source=first, target={"name": "disk"}, options=options)
            self.sketch, self._conversation = sketch, Conversation(sketch, folder)
            if at_once:
                self._answer()
            self.observe(self._answer, names=["source", "target", "options"])
            self.observe(lambda _: self.set_trait("uploads", self._conversation.take(self.upload)), names=["upload"])
            self.observe(lambda _: self.set_trait("file", self._conversation.keep(self.wish)), names=["wish"])

        def _answer(self, _: Any = None) -> None:
            for name, answer in self._conversation.answer(self.source, self.target, self.options):
                self.set_trait(name, answer)

        def __repr__(self) -> str:
            return f"A playground, alive in JupyterLab.\n{_INSTRUCTIONS}"

    return Playground


def _face(*names: str) -> str:
    """The text of files of the folder static, one after the other."""
    return "\n".join((_STATIC / name).read_text(encoding="utf-8") for name in names)
