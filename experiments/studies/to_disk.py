"""Table 1: how even is the morph to a circle, remeshed against random triangulations?

For every curve of the gallery and every letter, and for both of the paper's paths: the area-matrix
rank (AR) at three tolerances and the variance of the frame differences (Var), for the remeshed
triangulation, for the first and the last one of the table (what "arbitrary" may have meant), and for
many drawn uniformly from all.  Writes results/table1.csv, results/table1.json (with histograms of the
uniform ones) and results/table1_paper.csv (the paper's own numbers).
"""

import argparse
from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments.store import RESULTS, compute, rng_for, write_csv, write_json
from tween import Triangulation, area_matrix, decompose, frame_variance, gallery, morph, remesh
from tween.measuring.metrics import rank_of
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.compatible.paths import Path

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "samples": 1000,
    "frames": 100,
    "paths": ["linear", "slide"],
    "tolerances": [1e-4, 1e-6, 1e-9],
    "root": "disk-center",
    "disk": "equal area, vertices spaced by arc length",
}
QUANTILES = {"min": 0.0, "q05": 0.05, "q25": 0.25, "median": 0.5, "q75": 0.75, "q95": 0.95, "max": 1.0}
MEASURES = [*(f"AR_{tolerance:.0e}".replace("e-0", "e-") for tolerance in PARAMETERS["tolerances"]), "Var"]
PAPER: dict[
    str, list[Any]
] = {  # Table 1 as printed; the figure's curves are unpublished, its units and tolerance not stated
    "curve": ["Figure 11, row 1", "Figure 11, row 3", "Figure 11, row 4", "Figure 11, row 7"],
    "AR_remeshed": [7, 17, 10, 23],
    "AR_arbitrary": [31, 42, 13, 36],
    "Var_remeshed": [0.01, 0.01, 0.007, 0.007],
    "Var_arbitrary": [0.11, 0.02, 0.008, 0.03],
}


def shapes() -> dict[str, str]:
    """The study's curves: name -> kind."""
    letters = {f"letter {letter}": "letter" for letter in gallery.letters()}
    return {name: "constructed" for name in gallery.names()} | letters


def shape(name: str) -> Any:
    return gallery.letter(name.removeprefix("letter ")) if name.startswith("letter ") else gallery.curve(name)


class ToDisk:
    """The way of one curve's triangulations to one disk, vertex i to vertex i.

    To the last bit what `tween.area_matrix` makes of `tween.morph`.  But these look for the correspondence, and check
    the curve, anew for each of 68000 morphs; here both are known, and one root serves all paths.
    """

    def __init__(self, points: NDArray[np.float64], disk: NDArray[np.float64], frames: int) -> None:
        times = np.linspace(0.0, 1.0, frames)
        # A morph is computed from the shape whose bytes come first, so that it is symmetric.
        self._backwards = points.tobytes() > disk.tobytes()
        self._disk, self._times = disk, 1 - times if self._backwards else times

    def area_matrix(self, T: Triangulation, path: Path, root: int) -> NDArray[np.float64]:
        """Areas of the triangles in all frames, as shares of the source's area, (n-2, frames)."""
        first, last = (T.moved(self._disk), T.points) if self._backwards else (T, self._disk)
        x, y = np.ascontiguousarray(Leg(first, last, path, root).at(self._times).transpose(2, 1, 0))
        a, b, c = T.triangles.T
        return 0.5 * ((x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])) / T.areas.sum()

    def measure(self, T: Triangulation, paths: Sequence[Path]) -> list[list[float]]:
        """AR at every tolerance, then Var, a row a path."""
        root = root_triangle(PARAMETERS["root"], T, T.moved(self._disk))
        return [measures(self.area_matrix(T, path, root)) for path in paths]


def measures(A: NDArray[np.float64]) -> list[float]:
    """AR at every tolerance, then Var, of an area matrix."""
    singular = np.linalg.svd(A, compute_uv=False)
    return [*(rank_of(singular, rtol) for rtol in PARAMETERS["tolerances"]), frame_variance(A)]


def measure(T: Triangulation, disk: NDArray[np.float64], path: Path) -> list[float]:
    """AR at every tolerance, then Var, of the morph to the disk."""
    return measures(area_matrix(morph(T, T.moved(disk), path=path, root=PARAMETERS["root"]), PARAMETERS["frames"]))


def percentile(value: float, distribution: NDArray[np.float64]) -> float:
    """Share of the distribution below a value, ties counted half."""
    return float(np.mean(distribution < value) + 0.5 * np.mean(distribution == value))


def study(name: str, samples: int) -> dict[str, Any]:
    """Everything about one curve: its rows of the table and its histograms."""
    decomposition = decompose(shape(name))
    remeshed = remesh(decomposition.arbitrary())
    disk = remeshed.on_disk().points
    single = {"remeshed": remeshed, "first": decomposition.arbitrary(), "last": decomposition.arbitrary("last")}
    uniform = decomposition.sample(rng_for(PARAMETERS["seed"], name), samples)
    about = {"curve": name, "kind": shapes()[name], "n": len(remeshed), "log10_count": _log10(decomposition.count)}
    way = ToDisk(remeshed.points, disk, PARAMETERS["frames"])
    drawn_by_path = np.array([way.measure(T, PARAMETERS["paths"]) for T in uniform]).swapaxes(0, 1)
    rows, histograms = [], {}
    for path, drawn in zip(PARAMETERS["paths"], drawn_by_path, strict=True):
        about_path = about | {"path": path}
        for label, T in single.items():
            values = measure(T, disk, path)
            places = [percentile(v, column) for v, column in zip(values, drawn.T, strict=True)]
            rows.append(about_path | {"triangulation": label} | _named(values, places))
        for label, q in QUANTILES.items():
            values = np.quantile(drawn, q, axis=0, method="inverted_cdf").tolist()
            rows.append(about_path | {"triangulation": f"uniform_{label}"} | _named(values))
        histograms[path] = _histograms(drawn)
    return {"rows": rows, "histograms": {name: histograms}}


def _log10(count: int) -> float:
    digits = len(str(count)) - 1
    return round(digits + float(np.log10(count / 10**digits)), 2)


def _named(values: list[float], places: list[float] | None = None) -> dict[str, float | None]:
    named: dict[str, float | None] = {m: v for m, v in zip(MEASURES, values, strict=True)}
    return named | {f"percentile_{m}": places[i] if places else None for i, m in enumerate(MEASURES)}


def _histograms(drawn: NDArray[np.float64]) -> dict[str, Any]:
    """How often each AR occurs; Var at every twentieth."""
    counts = {
        m: {str(k): v for k, v in sorted(Counter(c.astype(int).tolist()).items())}
        for m, c in zip(MEASURES[:-1], drawn.T[:-1], strict=True)
    }
    twentieths = np.quantile(drawn[:, -1], np.linspace(0, 1, 21), method="inverted_cdf")
    return counts | {"Var": [float(f"{v:.4e}") for v in twentieths]}


def table(results: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows of all curves, numbers rounded so that they agree across processors."""
    rows = pd.DataFrame([row for result in results for row in result["rows"]])
    ranks, places = MEASURES[:-1], [f"percentile_{m}" for m in MEASURES]
    rows[ranks] = rows[ranks].astype(int)
    rows["Var"] = rows["Var"].map("{:.3e}".format)
    rows[places] = rows[places].astype(float).round(4)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m experiments.table1", description=__doc__.split("\n")[0])
    parser.add_argument("--samples", type=int, default=PARAMETERS["samples"], help="uniform triangulations per curve")
    parser.add_argument(
        "--only", nargs="+", choices=shapes(), metavar="CURVE", help="these curves alone; prints, writes nothing"
    )
    arguments = parser.parse_args()
    names = list(shapes())
    if arguments.only:
        print(table([study(name, arguments.samples) for name in arguments.only]).to_string())
        return
    parameters = PARAMETERS | {"samples": arguments.samples}
    results = compute("table1", parameters, names, partial(study, samples=arguments.samples))
    write_csv(RESULTS / "table1.csv", table(results))
    histograms = {name: value for result in results for name, value in result["histograms"].items()}
    write_json(RESULTS / "table1.json", {"parameters": parameters, "uniform": histograms})
    write_csv(RESULTS / "table1_paper.csv", pd.DataFrame(PAPER))
    print(f"table1: {len(names)} curves -> results/table1.csv, results/table1.json")


if __name__ == "__main__":
    main()
