"""Strokes as shaky hands draw them: outlines of the gallery with tremor, retraced starts, tiny loops and gaps."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from tween import gallery
from tween.gallery.generators import evenly
from tween.geometry.curve import turning_number

_TINY = 0.006  # radius of a tiny loop, as a share of the diagonal
_SEEDS = range(400)


class Fault(NamedTuple):
    """What is wrong with a stroke; lengths are shares of its own.

    tremor: root mean square, as a share of the diagonal; wave: how many points its bumps are long; retraced: how far
    the hand goes back over the start (the end, where less than 0); loops: how many tiny ones; gap: what is missing.
    """

    tremor: float
    wave: float = 0.0
    retraced: float = 0.0
    loops: int = 0
    gap: float = 0.0
    points: int = 900


KINDS = (
    Fault(0.004, points=3000),
    Fault(0.003, wave=6, retraced=0.03),
    Fault(0.002, wave=3, loops=12),
    Fault(0.003, wave=8, gap=0.012),
    Fault(0.003, wave=2, retraced=-0.04, loops=5),
)
SHAPES = (
    *(
        "horseshoe",
        "loop",
        "pretzel",
        "three_lobes",
        "ell",
        "comb",
        "ess",
        "spiral_2",
        "e",
        "o",
        "Q",
        "z",
        "l",
        "d",
        "S",
    ),
    *("two_loops", "winding_3", "two_disks", "five_disks", "arrow"),
)


def outline(name: str, k: int) -> NDArray[np.float64]:
    """Return points along a curve of the gallery or a letter, from its start around to its start."""
    p = (gallery.letter(name) if len(name) == 1 else gallery.curve(name)).points
    return evenly(np.concatenate([p, p[:1]]), k)


def diagonal(p: NDArray[np.float64]) -> float:
    return float(np.hypot(*np.ptp(p, axis=0)))


def noisy(name: str, fault: Fault, seed: int) -> NDArray[np.float64]:
    """Draw a shape with a shaky hand."""
    rng = np.random.default_rng(seed)
    p = outline(name, fault.points)
    size, k = diagonal(p), len(p)
    back = int(abs(fault.retraced) * k)
    if fault.retraced > 0:
        p = np.concatenate([p[:back], p[back:0:-1], p])
    elif fault.retraced < 0:
        p = np.concatenate([p, p[1:back]])
    p = p[: len(p) - int(fault.gap * k)]
    shake = rng.normal(size=p.shape)
    if fault.wave:
        shake = gaussian_filter1d(shake, fault.wave, axis=0)
    return _with_loops(p + fault.tremor * size * shake / shake.std(), fault.loops, _TINY * size, rng)


def _with_loops(p: NDArray[np.float64], count: int, radius: float, rng: np.random.Generator) -> NDArray[np.float64]:
    angle = np.linspace(0, 2 * np.pi, 14)[1:-1]
    for i in sorted(rng.choice(len(p) - 2, count, replace=False) + 1, reverse=True):
        side = rng.choice([-1, 1])
        loop = p[i] + radius * np.stack([np.sin(angle), side * (1 - np.cos(angle))], axis=1)
        p = np.concatenate([p[: i + 1], loop, p[i:]])
    return p


def twenty() -> list[tuple[str, NDArray[np.float64]]]:
    """Return every shape with one kind of fault, each of the five kinds four times."""
    return [(name, noisy(name, KINDS[k % len(KINDS)], seed=k)) for k, name in enumerate(SHAPES)]


def refused() -> list[tuple[int, NDArray[np.float64]]]:
    """Return five strokes of 3,000 points around whose tremor the hand turns 0, 7, 21, -4 and 2 times."""
    wanted = {0: "horseshoe", 7: "loop", 21: "pretzel", -4: "ell", 2: "e"}
    strokes = []
    for turns, name in wanted.items():
        drawn = (noisy(name, KINDS[0], seed) for seed in _SEEDS)
        strokes.append((turns, next(p for p in drawn if turning_number(p) == turns)))
    return strokes
