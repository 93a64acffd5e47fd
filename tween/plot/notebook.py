"""What shows a morph in a notebook: a film strip for every reader, a slider for whoever runs the cell.

A page that is only read, on GitHub or as HTML, shows the strip, and so does a notebook that a program runs; a slider
needs somebody to pull it.
"""

import base64
import importlib.util
import io
import sys
from collections.abc import Iterable
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

from tween.choices import Style
from tween.morphing.morph import Morph
from tween.plot import pixels
from tween.plot.film import Film, record
from tween.plot.shapes import draw_filmstrip

_WIDTH, _HEIGHT = 7.2, 2.4  # inches, of the strip at most


def slider(
    m: Morph, shapes: int = 61, strip: int = 7, size: int = 360, style: Style = "triangles", live: bool | None = None
) -> "Slider":
    """Put a morph under a slider, in a notebook.

    Parameters
    ----------
    m : Morph
    shapes : int
        How many shapes the slider stops at, evenly spaced in time, source and target included, at least 2.
    strip : int
        How many shapes the film strip has, at least 2.
    size : int
        Pixels of the longer side of a shape under the slider.
    style : {"triangles", "outline", "fill"}
        As for `save_animation`.
    live : bool, optional
        Whether to make a slider; by default where a person has run the cell and ipywidgets is installed.

    Returns
    -------
    Slider
        As the last line of a cell it shows itself.

    Raises
    ------
    ValueError
        Where a number or the style is none of those.

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> slider(morph(T, T.on_disk()), live=False)
    From t = 0 to t = 1 in 7 shapes; run in JupyterLab, this cell has a slider with 61.
    """
    if strip < 2:
        raise ValueError(f"strip is {strip}, expected 2 shapes at least")
    film = record(m, frames=shapes, size=size, style=style, ease=False, hold=0.0, there_and_back=False)
    wanted = has_front_end() and importlib.util.find_spec("ipywidgets") is not None if live is None else live
    return Slider(m, film, strip, wanted)


def has_front_end() -> bool:
    """Tell whether a person has run the cell.

    Returns
    -------
    bool
        False outside notebooks, and where a program runs them, since it says that nobody could be asked for input.

    Examples
    --------
    >>> has_front_end()
    False
    """
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    message: dict[str, Any] = getattr(shell, "get_parent", dict)() or {}
    return bool(message.get("content", {}).get("allow_stdin"))


class Slider:
    """A film strip, and a slider through the same morph where it is live; made by `slider`.

    Parameters
    ----------
    m : Morph
    film : Film
        What the slider goes through.
    strip : int
        Shapes of the film strip.
    live : bool
        Whether there is a slider.
    """

    def __init__(self, m: Morph, film: Film, strip: int, live: bool) -> None:
        self._m, self._film, self._count, self._live = m, film, strip, live

    @cached_property
    def widget(self) -> Any:
        """The picture above its slider and a button that plays it, an `ipywidgets.VBox`."""
        import ipywidgets

        picture = ipywidgets.Image(
            value=self.picture(0), format="png", layout={"align_self": "flex-start", "max_width": "100%"}
        )
        last = len(self._film.times) - 1
        moment = ipywidgets.IntSlider(max=last, readout=False, description="t", layout={"width": "24em"})
        play = ipywidgets.Play(max=last, interval=round(1000 / self._film.fps))
        caption = ipywidgets.Label(self.caption(0))
        ipywidgets.jslink((play, "value"), (moment, "value"))

        def show(change: dict[str, Any]) -> None:
            picture.value, caption.value = self.picture(change["new"]), self.caption(change["new"])

        moment.observe(show, "value")
        return ipywidgets.VBox([picture, ipywidgets.HBox([play, moment, caption])])

    def picture(self, k: int) -> bytes:
        """Draw one shape as PNG.

        Parameters
        ----------
        k : int
            Its number.

        Returns
        -------
        bytes
        """
        return _png(pixels.picture(self._film, k))

    def caption(self, k: int) -> str:
        """Say at which time a shape is, and how many flips lie behind it.

        Parameters
        ----------
        k : int
            Its number.

        Returns
        -------
        str
        """
        total = len(self._m.events)
        flips = f", {self._film.flips[k]} of {total} flips done" if total else ""
        return f"{self._film.times[k]:.2f}{flips}"

    def strip(self) -> bytes:
        """Draw the film strip as PNG.

        Returns
        -------
        bytes
        """
        figure = Figure(figsize=(_WIDTH, _HEIGHT))
        draw_filmstrip(self._m, np.linspace(0, 1, self._count), figure.add_subplot())
        stream = io.BytesIO()
        figure.savefig(stream, format="png", bbox_inches="tight", dpi=110, metadata={"Software": None})
        return stream.getvalue()

    def __repr__(self) -> str:
        live = f"run in JupyterLab, this cell has a slider with {len(self._film.times)}"
        return f"From t = 0 to t = 1 in {self._count} shapes; {live}."

    def _repr_mimebundle_(
        self, include: Iterable[str] | None = None, exclude: Iterable[str] | None = None
    ) -> dict[str, Any]:
        """What the front end chooses from: the strip always, and the slider where it is live."""
        bundle = {"text/plain": repr(self), "image/png": base64.b64encode(self.strip()).decode("ascii")}
        return bundle | self.widget._repr_mimebundle_() if self._live else bundle


def _png(image: Image.Image) -> bytes:
    stream = io.BytesIO()
    image.save(stream, format="PNG")
    return stream.getvalue()
