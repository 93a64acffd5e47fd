"""Whether the same shapes give the same morph, wherever they lie, however large they are, and from either end.

Both curves of a pair are turned, scaled and moved together, and the morph is compared with the one of the curves as
they were, moved likewise; and a pair is morphed the other way round.  The pairs are random disks, symmetric curves, on
which the best correspondence is not unique, and curves of the gallery and letters.

    python -m experiments.equivariance OUT.jsonl --seeds 0 1000

appends a line a pair; seeds that stand in the file already are passed over.  At the end it prints what the file
holds, for each kind of pair.
"""

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import subjects
from experiments.seeds import asked, collected
from tween import gallery, morph
from tween.choices import PATHS
from tween.choices import Path as Path
from tween.errors import GuaranteeError

TIMES = np.array([0.0, 0.013, 0.21, 0.5, 0.77, 0.999, 1.0])
SAME = 1e-9  # of the width
KINDS = ("disks", "disks", "symmetric", "symmetric", "curves")

Points = NDArray[np.float64]


def regular(rng: np.random.Generator) -> Points:
    """A curve with symmetries: a polygon, a star, a rectangle, a cross or a Z."""
    kind, n = rng.integers(5), int(rng.integers(3, 9))
    if kind == 0:
        return subjects.polygon(n)
    if kind == 1:
        return subjects.polygon(2 * n) * np.where(np.arange(2 * n) % 2, 1.0, rng.uniform(0.3, 0.8))[:, None]
    w, h = rng.integers(1, 5, 2).tolist()
    if kind == 2:
        return np.array([[0, 0], [w, 0], [w, h], [0, h]], dtype=float)
    if kind == 3:
        arm = [[1, w + 1], [-1, w + 1], [-1, 1]]
        return np.array([[(x, y), (-y, x), (-x, -y), (y, -x)][k] for k in range(4) for x, y in arm], dtype=float)
    return np.array([[0, 0], [1, 0], [1, h], [w + 1, h], [w + 1, h + 1], [0, h + 1]], dtype=float)


def ends(seed: int) -> tuple[str, Points, Points]:
    """The kind of a pair, and its two curves."""
    rng = np.random.default_rng([22, seed])
    kind = KINDS[seed % len(KINDS)]
    if kind == "disks":
        n = int(rng.integers(5, 15))
        m = n if rng.random() < 0.5 else int(rng.integers(5, 15))
        return kind, gallery.random_disk(n, rng).points, gallery.random_disk(m, rng).points
    if kind == "symmetric":
        return kind, regular(rng), regular(rng)
    first, second = rng.choice(list(subjects.shapes()), 2, replace=False)
    return kind, subjects.shape(first).points, subjects.shape(second).points


def similarity(rng: np.random.Generator) -> tuple[float, float, Points]:
    """An angle, a scale and a step."""
    return float(rng.uniform(0, 2 * np.pi)), float(10.0 ** rng.uniform(-3, 3)), rng.normal(size=2)


def moved(points: Points, angle: float, scale: float, step: Points) -> Points:
    """Points, (..., 2), turned and scaled about the origin and then moved by a step of the size of the shape."""
    c, s = scale * np.cos(angle), scale * np.sin(angle)
    return np.asarray(points @ np.array([[c, s], [-s, c]]) + scale * step)


def differences(first: Points, second: Points, path: Path, rng: np.random.Generator) -> dict[str, float]:
    """By which share of the width morphs differ that should be the same: turned, scaled, both, and exchanged."""
    plain = morph(first, second, path=path)
    shapes, width = plain.at(TIMES), float(max(np.ptp(end, axis=0).max() for end in (first, second)))
    angle, scale, step = similarity(rng)
    found = {}
    for name, own in (
        ("rotation", (angle, 1.0, 0 * step)),
        ("scaling", (0.0, scale, 0 * step)),
        ("similarity", (angle, scale, step)),
    ):
        other = morph(moved(first, *own), moved(second, *own), path=path)
        found[name] = apart(other.at(TIMES), moved(shapes, *own)) / (width * own[1])
    back = morph(second, first, path=path)
    start = int(np.flatnonzero(back.target_vertices == 0)[0])
    found["exchange"] = apart(np.roll(back.at(1 - TIMES), -start, axis=1), shapes) / width
    return found


def apart(shapes: Points, expected: Points) -> float:
    """The largest distance between shapes; infinite where the counts of vertices differ."""
    return float(np.abs(shapes - expected).max()) if shapes.shape == expected.shape else np.inf


def compared(seed: int) -> dict[str, Any]:
    """Compare the morphs of one pair."""
    kind, first, second = ends(seed)
    path = PATHS[seed // len(KINDS) % len(PATHS)]
    row: dict[str, Any] = {"seed": seed, "kind": kind, "path": path}
    try:
        return row | differences(first, second, path, np.random.default_rng([23, seed]))
    except GuaranteeError as error:
        return row | {"words": str(error)}


def summary(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """For each kind the pairs, those refused, and for each change the pairs that differ by more than 1e-9."""
    names = ["rotation", "scaling", "similarity", "exchange"]
    table = pd.DataFrame(rows).reindex(columns=["kind", "path", "words", *names])
    differ = table.assign(refused=table["words"].notna(), **{name: table[name] > SAME for name in names})
    groups = differ.groupby("kind", sort=False)
    found = groups[["refused", *names]].sum()
    return found.assign(pairs=groups.size()).reset_index()


def main() -> None:
    out, seeds = asked(str(__doc__).splitlines()[0])
    print(summary(collected(out, seeds, lambda seed: [compared(seed)])).to_string(index=False))


if __name__ == "__main__":
    main()
