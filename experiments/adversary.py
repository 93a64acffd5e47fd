"""A search for moments at which a guaranteed morph is not valid, among ends that make it hard.

Fans of up to 60 spokes with radii to 1e3, random disks whose angle sums come up to 1e-12 to 2 pi, needles, stretches
by powers of ten, coordinates of 1e6, different counts of vertices and flips; all paths and roots.  Every morph that is
given with a guarantee is checked exactly, by `tween.verify`, at 2,000 times: spread evenly, beside every flip and end,
and where the largest sum of angles is largest, found by going up from the worst moments seen.

    python -m experiments.adversary OUT.jsonl --seeds 0 1000

appends one line a morph; seeds that stand in the file already are passed over.
"""

import argparse
import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tween
from tween import gallery
from tween.choices import PATHS, ROOT_RULES
from tween.errors import CurveError, GuaranteeError, IncompatibleError, NotSelfOverlappingError, TweenError
from tween.geometry.triangulation import Triangulation
from tween.measuring.frame_check import Checked, check, fault_words
from tween.morphing.compatible.leg import left_below_full_turn

TIMES = 2000
ENDS = 10.0 ** -np.arange(2.0, 18.0, 0.5)


def fan(rng: np.random.Generator) -> tuple[Triangulation, Triangulation]:
    """Two fans about vertex 0 with equally many spokes, of very different lengths and angles."""
    spokes = int(rng.integers(3, 61))
    triangles = [[0, i, i + 1] for i in range(1, spokes)]
    shapes = []
    for _ in range(2):
        whole = 2 * np.pi - 10.0 ** rng.uniform(-12, 0.5)
        gaps = rng.dirichlet(np.full(spokes - 1, 10.0 ** rng.uniform(-1, 1))) * whole
        gaps = np.clip(gaps, 1e-6, np.pi - 1e-3)
        gaps *= min(1.0, whole / gaps.sum())
        angles = np.concatenate([[0.0], np.cumsum(gaps)]) + rng.uniform(0, 7)
        radii = 10.0 ** (rng.uniform(0, 3) * rng.uniform(-0.5, 0.5, spokes))
        z = np.concatenate([[0.0], radii * np.exp(1j * angles)])
        shapes.append(Triangulation(np.stack([z.real, z.imag], axis=1), triangles))
    return shapes[0], shapes[1]


def tight_disk(rng: np.random.Generator, n: int) -> Triangulation:
    """A random disk with one vertex whose angles add up to almost 2 pi."""
    T = gallery.random_disk(n, rng)
    v = int(np.argmin(left_below_full_turn(T)))
    before, here, after = (T.points[(v + s) % n] for s in (-1, 0, 1))
    points, wanted = T.points.copy(), 10.0 ** rng.uniform(-12, -1)
    direction, length = before - here, np.hypot(*(after - here))
    turned = np.array([[np.cos(wanted), np.sin(wanted)], [-np.sin(wanted), np.cos(wanted)]]).T @ direction
    points[(v + 1) % n] = here + turned / np.hypot(*turned) * length
    return T.moved(points)


def stretched(rng: np.random.Generator, T: Triangulation) -> Triangulation:
    """The shape pressed flat in some direction by up to 1e-9."""
    turn = rng.uniform(0, np.pi)
    c, s = np.cos(turn), np.sin(turn)
    return T.moved(T.points @ np.array([[c, -s], [s, c]]) * [1.0, 10.0 ** rng.uniform(-9, 0)])


def one_end(rng: np.random.Generator, n: int) -> Triangulation:
    kind = rng.integers(4)
    T = tight_disk(rng, n) if kind == 0 else gallery.random_disk(n, rng)
    if kind == 1:
        T = stretched(rng, T)
    if kind == 2:
        T = T.moved(T.points * 10.0 ** rng.uniform(-6, 6))
    return T


def pair(rng: np.random.Generator) -> tuple[str, Any, Any, dict[str, Any]]:
    """What to morph: the kind, both ends, and options."""
    kind = str(rng.choice(["fan", "same", "flips", "counts", "far", "disk"]))
    n = int(rng.integers(5, 24))
    if kind == "fan":
        return kind, *fan(rng), {}
    T = one_end(rng, n)
    if kind == "disk":
        return kind, T, T.on_disk() if T.areas.min() > 0 else T, {}  # one that is not valid has no disk, and is refused
    if kind == "same":
        return kind, T, stretched(rng, stretched(rng, T)), {}
    m = int(rng.integers(5, 24)) if kind == "counts" else n
    offset = rng.normal(size=2) * (1e6 if kind == "far" else 0.0)
    return (
        kind,
        T.points + offset,
        one_end(rng, m).points + offset,
        {"strategy": str(rng.choice(["auto", "common", "paper"], p=[0.05, 0.25, 0.7]))},
    )


def examined(m: tween.Morph, rng: np.random.Generator, count: int) -> tuple[Checked, NDArray[np.int64]]:
    """Check a morph at many times, each once: a third of them beside flips and ends, a third where sums are largest.

    Parameters
    ----------
    m : Morph
    rng : numpy.random.Generator
    count : int
        Times at least.

    Returns
    -------
    Checked
        What the kernels of `tween.verify` find of every frame, all frames of a round at once.
    lists : ndarray of int, shape (stages, n-2, 3)
        The triangles in force, by stage.
    """
    marks = np.array([0.0, 1.0, *(e.time for e in m.events)])
    lists = np.zeros((m.stage_at(np.ones(1))[0] + 1, *m.source.triangles.shape), np.int64)

    def found(times: NDArray[np.float64]) -> Checked:
        stage = m.stage_at(times)
        for number, first in zip(*np.unique(stage, return_index=True), strict=True):
            lists[number] = m.triangles_at(times[first])
        return check(times, stage, m.at(times), lists)

    some = rng.choice(marks, min(len(marks), 10), replace=False)
    beside = (np.concatenate([some, [0.0, 1.0]])[:, None] + np.concatenate([-ENDS, [0.0], ENDS])).ravel()
    times = np.unique(np.clip(np.concatenate([np.linspace(0, 1, 3 * count // 10), beside]), 0.0, 1.0))
    checked = found(times)
    radius, enough = 3 / count, max(count, len(checked.t) + count // 3)
    while len(checked.t) < enough:
        worst = checked.t[np.argsort(checked.sums.max(axis=1))[-12:]]
        times = np.clip((worst[:, None] + radius * rng.uniform(-1, 1, (12, 8))).ravel(), 0, 1)
        checked = checked.merged(found(times))
        radius *= 0.3
    return checked, lists


def tried(seed: int, times: int = TIMES) -> dict[str, Any]:
    """Make one guaranteed morph, and check it."""
    rng = np.random.default_rng([20, seed])
    kind, source, target, options = pair(rng)
    path, root = PATHS[rng.integers(len(PATHS))], ROOT_RULES[rng.integers(len(ROOT_RULES))]
    options["placement"] = str(rng.choice(["steady", "root"]))
    found: dict[str, Any] = {"seed": seed, "kind": kind, "path": path, "root": root} | options
    try:
        for end in (source, target):
            if isinstance(end, Triangulation):
                end.validate()
        m = tween.morph(source, target, path=path, root=root, guarantee=True, **options)
    except (CurveError, NotSelfOverlappingError, IncompatibleError, tween.errors.TriangulationError) as error:
        return found | {"result": "no ends", "words": str(error)}
    except GuaranteeError as error:
        return found | {"result": "refused", "words": str(error)}
    except TweenError as error:
        return found | {"result": "other", "words": str(error)}
    except Exception as error:  # an error from inside is what is looked for
        return found | {"result": "crash", "words": f"{type(error).__name__}: {error}"}
    checked, lists = examined(m, rng, times)
    broken = np.flatnonzero(checked.faults[:, 0])
    width = max(float(np.ptp(T.points, axis=0).max()) for T in (m.source, m.target))
    marks = np.array([0.0, 1.0, *(e.time for e in m.events)])
    sides = m.at(np.clip((marks[:, None] + [-1e-7, 0.0, 1e-7]).ravel(), 0, 1)).reshape(len(marks), 3, -1, 2)
    jump = float((sides.max(axis=1) - sides.min(axis=1)).max()) / width
    words = f"t = {checked.t[broken[0]]:.17g}: {fault_words(checked, lists, broken[0])[0]}" if len(broken) else ""
    result = "INVALID" if len(broken) else "valid"
    return found | {"result": result, "words": words, "flips": len(m.events), "times": len(checked.t), "jump": jump}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=int, nargs=2, default=(0, 1000))
    parser.add_argument("--times", type=int, default=TIMES, help="at which each morph is checked")
    arguments = parser.parse_args()
    lines = arguments.out.read_text().splitlines() if arguments.out.exists() else []
    done = {json.loads(line)["seed"] for line in lines}
    counts: dict[str, int] = {}
    with arguments.out.open("a") as file, warnings.catch_warnings():
        warnings.simplefilter("error")
        for seed in range(*arguments.seeds):
            if seed not in done:
                row = tried(seed, arguments.times)
                file.write(json.dumps(row) + "\n")
                file.flush()
                counts[row["result"]] = counts.get(row["result"], 0) + 1
                if seed % 100 == 99:
                    print(seed + 1, counts, flush=True)


if __name__ == "__main__":
    main()
