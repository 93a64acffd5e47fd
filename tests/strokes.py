"""Strokes as a hand draws them in a field of the playground, for the tests of it."""

import numpy as np
from numpy.typing import NDArray

from tween import gallery
from tween.app.playground.fields import fitting

LOOP, DISK = {"name": "loop"}, {"name": "disk"}


def circle(turns: float = 1.0, k: int = 90) -> NDArray[np.float64]:
    """Places of a hand that goes around once, or a little more or less."""
    t = 2 * np.pi * np.linspace(0, turns, k)
    return 500 + 300 * np.stack([np.cos(t), np.sin(t)], axis=1)


def eight() -> NDArray[np.float64]:
    t = np.linspace(0, 2 * np.pi, 90)
    return 500 + 300 * np.stack([np.sin(2 * t), np.sin(t)], axis=1)


def twice() -> NDArray[np.float64]:
    t = np.linspace(0, 2 * np.pi, 90)
    return 500 + 150 * np.stack([np.cos(t) + 1.2 * np.cos(2 * t), np.sin(t) + 1.2 * np.sin(2 * t)], axis=1)


def bows() -> NDArray[np.float64]:
    """Three bows in a row, the middle one traversed the other way."""
    t = np.linspace(0, 2 * np.pi, 120)
    x, y = 1.6 * np.cos(t) + 0.4 * np.cos(3 * t), 0.4 * np.sin(t) - 0.4 * np.sin(3 * t)
    return 500 + 220 * np.stack([x, y], axis=1)


def traced(name: str) -> NDArray[np.float64]:
    """Places of a hand that traces a curve of the gallery."""
    curve = gallery.curve(name).points
    points = np.reshape(fitting(curve).forth(curve), (-1, 2))
    return np.concatenate([points, points[:1]])
