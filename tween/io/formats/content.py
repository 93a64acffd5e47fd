"""What a file holds: outlines, marks, and what is not used of it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Pen(NamedTuple):
    """How a drawing program draws a line.

    Attributes
    ----------
    width : float
        In the units of the outline; 0 where none is given.
    cap : {"butt", "round", "square"}
        What the ends look like.
    join : {"miter", "round", "bevel"}
        What the corners look like.
    limit : float
        How far the tip of a mitred corner may lie from the line, in halves of the width; what is sharper is bevelled.
    alone : bool
        Whether the line is drawn and what it encloses is not filled.
    """

    width: float = 0.0
    cap: str = "butt"
    join: str = "miter"
    limit: float = 4.0
    alone: bool = False


class Outline(NamedTuple):
    """A line that a file holds.

    Attributes
    ----------
    name : str
        Empty where there is none.
    points : ndarray of float64, shape (n, 2)
        With y upwards; of a closed outline of SVG and GeoJSON the last equals the first.
    pen : Pen
    part : str
        What the outline is of something larger, such as "hole in 'island'"; empty where it is the whole.
    """

    name: str
    points: NDArray[np.float64]
    pen: Pen = Pen()
    part: str = ""


class Content(NamedTuple):
    """What a file holds.

    Attributes
    ----------
    outlines : list of Outline
    unused : list of str
        What else it holds, in words.
    marks : dict of str to (float, float)
        Places with a name: the centres of an SVG's circles, the points of a GeoJSON.
    """

    outlines: list[Outline]
    unused: list[str]
    marks: dict[str, tuple[float, float]]
