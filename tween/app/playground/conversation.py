"""What the browser says to a playground, and what it is answered: plain dictionaries, which become JSON.

source, target, options -> shapes, footage        upload -> uploads        wish -> file
"""

import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tween import gallery, plot
from tween.app.playground.fields import BOX
from tween.app.playground.sketch import HELP, KINDS, ROOTS, TRIANGULATIONS, Sketch
from tween.app.playground.wishes import SUFFIXES, in_words
from tween.choices import PATHS
from tween.errors import FileError

LANDMARKS = ("#AA3377", "#006B4F", "#8A4B00", "#5B3A8C", "#2F5FA5", "#5F6000")
"""Colours of landmarks, in turn; white numbers on them can be read."""

Answer = tuple[str, dict[str, Any]]


class Conversation:
    """Answers what a person does in a browser.

    Parameters
    ----------
    sketch : Sketch
    folder : path
        Where files are saved.

    Examples
    --------
    >>> said = Conversation(Sketch()).answer({"name": "loop"}, {"name": "disk"}, {"path": "slide", "asked": 1})
    >>> [(name, answer["asked"]) for name, answer in said]
    [('shapes', 1), ('footage', 1)]
    """

    def __init__(self, sketch: Sketch, folder: str | Path = ".") -> None:
        self.sketch = sketch
        self.folder = Path(folder)
        self._answered: Any = (None, None)

    def answer(
        self, source: Mapping[str, Any], target: Mapping[str, Any], options: Mapping[str, Any]
    ) -> Iterator[Answer]:
        """Judge two shapes, and morph one into the other; nothing is computed twice.

        Parameters
        ----------
        source, target : mapping
            See `.wishes`.
        options : mapping
            See `.Sketch.move`.  Further "asked", a number that goes back with the answers; and "dragging", whether a
            vertex is on its way, so that a verdict is all that is asked for.

        Yields
        ------
        name : {"shapes", "footage"}
            The verdicts go ahead of the morph, which may take a moment.
        answer : dict
        """
        asked, dragging = options.get("asked", 0), bool(options.get("dragging"))
        wish = (source, target, dragging), options
        if wish == self._answered:
            return
        same_shapes = wish[0] == self._answered[0]
        self._answered = wish
        if not same_shapes:
            yield "shapes", self.sketch.choose(source, target, brief=dragging) | {"asked": asked}
        if not dragging:
            wanted = {key: value for key, value in options.items() if key not in ("asked", "dragging")}
            yield "footage", self.sketch.move(wanted) | {"asked": asked}

    def keep(self, wish: Mapping[str, Any]) -> dict[str, Any]:
        """Save a file in the folder, or hand it to the browser, and say how that went.

        Parameters
        ----------
        wish : mapping
            kind, one of `.KINDS`; where, "browser" or "folder"; asked.

        Returns
        -------
        dict
            name, data (for the browser), words, asked.
        """
        return self._kept(wish) | {"asked": wish.get("asked", 0)}

    def _kept(self, wish: Mapping[str, Any]) -> dict[str, Any]:
        try:
            if wish.get("where") == "browser":
                with tempfile.TemporaryDirectory() as folder:
                    path = self.sketch.save(wish["kind"], folder)
                    return {"name": path.name, "data": path.read_bytes(), "words": f"Downloaded {path.name}."}
            path = self.sketch.save(wish["kind"], self.folder)
            size = max(1, round(path.stat().st_size / 1000))
            return {"name": path.name, "words": f"Saved {path.name}, {size} kB, in the current folder."}
        except Exception as error:  # a person at a widget has no use for a traceback
            return {"name": "", "words": f"Not saved: {in_words(error)}"}

    def take(self, upload: Mapping[str, Any]) -> dict[str, Any]:
        """Take a file that was handed in, and say how that went; what there is stays.

        Parameters
        ----------
        upload : mapping
            name, data (bytes), asked.

        Returns
        -------
        dict
            curves : the names of all that was handed in; chosen : that of the first curve of the file, or nothing;
            words : one line, where there is something to say; asked.
        """
        chosen, words = "", ""
        try:
            if not isinstance(upload.get("data"), bytes | bytearray | memoryview):
                raise FileError("no file came")
            names, words = self.sketch.take(str(upload.get("name", "")), bytes(upload["data"]))
            chosen = names[0]
            if len(names) > 1:
                several = f"The file holds {len(names)} curves; this is the first, and the menus have all."
                words = f"{several} {words}".strip()
        except Exception as error:  # as above
            words = in_words(error)
        curves = [name for name in self.sketch.curves if name != "given"]
        return {"curves": curves, "chosen": chosen, "words": words, "asked": upload.get("asked", 0)}


def setup(sketch: Sketch) -> dict[str, Any]:
    """Say what the browser has to know once: what can be chosen, and the colours of the figures.

    Parameters
    ----------
    sketch : Sketch

    Returns
    -------
    dict
    """
    colors = {"source": plot.SOURCE, "target": plot.TARGET, "pivot": plot.PIVOT, "failure": plot.FAILURE}
    return {
        "box": BOX,
        "given": sketch.given is not None,
        "curves": [[name, gallery.describe(name)] for name in gallery.names()],
        "letters": list(gallery.letters()),
        "suffixes": ",".join(SUFFIXES),
        "help": HELP,
        "paths": [[path] for path in PATHS],
        "roots": list(ROOTS.items()),
        "triangulations": list(TRIANGULATIONS.items()),
        "kinds": [[kind, words] for kind, (words, _) in KINDS.items()],
        "colors": colors | {"tree": plot.TREE},
        "landmarks": list(LANDMARKS),
    }
