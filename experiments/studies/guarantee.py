"""The guarantee: which morphs keep an immersed disk in every frame, with and without angle budgets?

For the gallery and the letters (to the disk), the pairs of Figure 11, pairs of handwritten letters, random immersed
disks (to the disk) and random pairs of them: for every path, plain and guaranteed, and for what others use, the share
of frames that bound an immersed disk by the independent exact checker, whether the guaranteed morph is certified
throughout, AR, Var, the largest conformal distortion, swelling (the largest area on the way over that of the larger
end), by what factors edges of the curve leave the range of their lengths at both ends (longest, shortest), and the
length of the vertices' paths ("way").  Shapes are placed by the root.  Writes results/guarantee.csv (a row a morph, the
random ones left out) and results/guarantee_summary.csv.
"""

from collections.abc import Iterator
from itertools import islice
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments.baselines import BASELINES
from experiments.measures import edge_factors, swelling
from experiments.store import RESULTS, compute, rng_for, write_csv
from tween import Morph, area_matrix, area_rank, certify, frame_variance, gallery, remesh, triangulate, verify
from tween.choices import PATHS
from tween.morphing.motions import Choices, between
from tween.morphing.strategy import without_match
from tween.triangulating.costs import conformal_distortion

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 61,
    "random_disks": 500,
    "n": 50,
    "batch": 25,
    "random_pairs": 50,
    "n_pairs": 30,
    "batch_pairs": 10,
    "letter_pairs": 25,
}
MEASURES = ["AR_1e-9", "Var", "distortion", "swelling", "longest", "shortest", "way"]


def subjects(part: str) -> Iterator[tuple[str, Any, Any]]:
    """Names, sources and targets of a part of the study."""
    kind, rest = part.split(": ")
    if kind == "disk":
        for name in rest.split(" "):
            T = triangulate(gallery.letter(name) if len(name) == 1 else gallery.curve(name))
            yield name, T, T.on_disk()
    elif kind == "pair":
        source, target = gallery.pair(rest)
        yield rest, source, target
    elif kind == "letters":
        first, second = rest.split("-")
        yield rest, gallery.letter(first), gallery.letter(second)
    elif kind == "random pair":
        rng = rng_for(PARAMETERS["seed"], part)
        for i in range(PARAMETERS["batch_pairs"]):
            disks = [remesh(gallery.random_disk(PARAMETERS["n_pairs"], rng)) for _ in range(2)]
            yield f"{rest}.{i}", disks[0], disks[1]
    else:
        rng = rng_for(PARAMETERS["seed"], part)
        for i in range(PARAMETERS["batch"]):
            T = remesh(gallery.random_disk(PARAMETERS["n"], rng))
            yield f"{rest}.{i}", T, T.on_disk()


def parts() -> list[str]:
    singles = [f"disk: {name}" for name in (*gallery.names(), *gallery.letters())]
    rng = rng_for(PARAMETERS["seed"], "letter pairs")
    letters = [gallery.letters()[i] + "-" + gallery.letters()[j] for i, j in _distinct(rng)]
    batches = range(PARAMETERS["random_disks"] // PARAMETERS["batch"])
    pair_batches = range(PARAMETERS["random_pairs"] // PARAMETERS["batch_pairs"])
    return [
        *singles,
        *(f"pair: {name}" for name in gallery.pairs()),
        *(f"letters: {pair}" for pair in letters),
        *(f"random disk: {batch}" for batch in batches),
        *(f"random pair: {batch}" for batch in pair_batches),
    ]


def _distinct(rng: np.random.Generator) -> list[tuple[int, int]]:
    """Different pairs of different letters."""
    count = len(gallery.letters())
    drawn = (tuple(sorted(rng.choice(count, 2, replace=False).tolist())) for _ in iter(int, 1))
    return list(islice(dict.fromkeys(islice(drawn, 4 * PARAMETERS["letter_pairs"])), PARAMETERS["letter_pairs"]))


def ways(source: Any, target: Any) -> Iterator[tuple[str, bool, Morph]]:
    """Every path, plain and guaranteed, and the baselines on the same correspondence."""
    alignment, exchanged = without_match("paper", source, target)
    for path in PATHS:
        for guarantee in (False, True):
            m = between(alignment, Choices(path, guarantee, "root", "disk-center", exchanged=exchanged))
            yield path, guarantee, m
    for name, make in BASELINES.items():
        yield name, False, make(m.source, m.target)


def measure(m: Morph) -> dict[str, Any]:
    """Frames that bound a disk, and what the morph is like."""
    times = np.linspace(0, 1, PARAMETERS["frames"])
    frames = m.at(times)
    _, first, stage = np.unique(m.stage_at(times), return_index=True, return_inverse=True)
    triangles = np.array([m.triangles_at(t) for t in times[first]])[stage]
    certificate = verify(frames, triangles, times)
    A = area_matrix(m, PARAMETERS["frames"])
    longest, shortest = edge_factors(frames)
    return {
        "frames_failed": certificate.frames_failed,
        "largest_sum": certificate.max_angle / np.pi,
        "AR_1e-9": area_rank(A, 1e-9),
        "Var": frame_variance(A),
        "distortion": distortion(frames, triangles),
        "swelling": swelling(A),
        "longest": longest,
        "shortest": shortest,
        "way": way(frames),
    }


def throughout(m: Morph) -> str:
    """What the certificate says of the times between the frames.

    Without a proof it refines until no rule can break at the rates of change measured, or until its limit; which
    of the two happens first may differ between processors, so neither is told here.
    """
    if not certify(m, PARAMETERS["frames"]).valid:
        return "no"
    return "by construction" if m.proof else "at the frames"


def distortion(frames: NDArray[np.float64], triangles: NDArray[np.int64]) -> float:
    """The largest ratio of singular values of the maps of triangles from the first frame that has them."""
    k, n = frames.shape[:2]
    new = [True, *(triangles[1:] != triangles[:-1]).any(axis=(1, 2))]
    first = np.maximum.accumulate(np.where(new, np.arange(k), 0))
    cost = conformal_distortion(frames[first].reshape(-1, 2), frames.reshape(-1, 2))  # all frames as one shape
    return max(1.0, float(cost((triangles + n * np.arange(k)[:, None, None]).reshape(-1, 3)).max()))


def way(frames: NDArray[np.float64]) -> float:
    """Mean length of the ways of the vertices, in diameters of the source."""
    steps = np.diff(frames, axis=0)
    return float(np.hypot(steps[..., 0], steps[..., 1]).sum(axis=0).mean() / np.ptp(frames[0], axis=0).max())


def work(part: str) -> list[dict[str, Any]]:
    rows = []
    for name, source, target in subjects(part):
        for path, guarantee, m in ways(source, target):
            about = {"kind": part.split(": ")[0], "name": name, "path": path, "guarantee": guarantee}
            certified = throughout(m) if guarantee and not name[0].isdigit() else ""
            rows.append(about | {"flips": len(m.events), "certified": certified} | measure(m))
    return rows


def summary(table: pd.DataFrame) -> pd.DataFrame:
    """Shares of morphs and frames that bound a disk, medians of the rest."""
    groups = table.groupby(["kind", "path", "guarantee"], sort=False)
    result = groups.agg(morphs=("name", "size"), valid=("frames_failed", lambda f: int((f == 0).sum())))
    result["frames_failed"] = groups["frames_failed"].sum()
    result["frames"] = result["morphs"] * PARAMETERS["frames"]
    return pd.concat([result, groups[MEASURES].median()], axis=1).reset_index()


def rounded(table: pd.DataFrame) -> pd.DataFrame:
    """Round to what other processors agree on: of a triangle that is nearly flat, no digit of the distortion."""
    table = table.copy()
    table["Var"] = table["Var"].map(lambda v: "<1e-20" if v < 1e-20 else f"{v:.2e}")
    for column in ("distortion", "swelling", "longest", "shortest", "way", "largest_sum"):
        if column in table:
            table[column] = table[column].map(lambda v: "above 1e3" if v > 1e3 else f"{v:.4g}")
    return table


def main() -> None:
    rows = [row for part in compute("guarantee", PARAMETERS, parts(), work) for row in part]
    table = pd.DataFrame(rows)
    write_csv(RESULTS / "guarantee.csv", rounded(table[~table.kind.str.startswith("random")]))
    write_csv(RESULTS / "guarantee_summary.csv", rounded(summary(table)))
    print(f"guarantee: {len(table)} morphs -> results/guarantee.csv, results/guarantee_summary.csv")


if __name__ == "__main__":
    main()
