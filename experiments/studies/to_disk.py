"""Table 1: how even is the morph to a circle, remeshed against random triangulations?

For every curve of the gallery and every letter, and for both of the paper's paths: the area-matrix
rank (AR) at three tolerances and the variance of the frame differences (Var), for the remeshed
triangulation, for the first and the last one of the table (what "arbitrary" may have meant), and for
many drawn uniformly from all.  Writes results/table_1_to_disk.csv, results/table_1_to_disk.json (with histograms of the
uniform ones) and results/table_1_paper.csv (the paper's own numbers).
"""

import argparse
from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments.measures import (
    MEASURES,
    PARAMETERS,
    QUANTILES,
    RANKS,
    areas_to_disk,
    measures,
    percentile,
    usual_root,
)
from experiments.store import RESULTS, compute, rng_for, write_csv, write_json
from experiments.subjects import PAPER, shape, shapes
from tween import Triangulation, decompose, remesh


def study(name: str, samples: int) -> dict[str, Any]:
    """Everything about one curve: its rows of the table and its histograms."""
    decomposition = decompose(shape(name))
    remeshed = remesh(decomposition.arbitrary())
    disk = remeshed.on_disk().points
    single = {"remeshed": remeshed, "first": decomposition.arbitrary(), "last": decomposition.arbitrary("last")}
    uniform = decomposition.sample(rng_for(PARAMETERS["seed"], name), samples)
    about = {"curve": name, "kind": shapes()[name], "n": len(remeshed), "log10_count": _log10(decomposition.count)}
    rows, histograms = [], {}
    measured, of_single = by_path(uniform, disk), by_path(list(single.values()), disk)
    for i, path in enumerate(PARAMETERS["paths"]):
        drawn = measured[:, i]
        about_path = about | {"path": path}
        for label, values in zip(single, of_single[:, i].tolist(), strict=True):
            places = [percentile(v, column) for v, column in zip(values, drawn.T, strict=True)]
            rows.append(about_path | {"triangulation": label} | _named(values, places))
        for label, q in QUANTILES.items():
            values = np.quantile(drawn, q, axis=0, method="inverted_cdf").tolist()
            rows.append(about_path | {"triangulation": f"uniform_{label}"} | _named(values))
        histograms[path] = _histograms(drawn)
    return {"rows": rows, "histograms": {name: histograms}}


def by_path(triangulations: Sequence[Triangulation], disk: NDArray[np.float64]) -> NDArray[np.float64]:
    """The measures of the morphs to the disk, (triangulations, paths, measures)."""
    found = []
    for T in triangulations:
        root = usual_root(T, disk)
        found.append([measures(areas_to_disk(T, disk, path, root=root)) for path in PARAMETERS["paths"]])
    return np.array(found)


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
        for m, c in zip(RANKS, drawn.T[:-1], strict=True)
    }
    twentieths = np.quantile(drawn[:, -1], np.linspace(0, 1, 21), method="inverted_cdf")
    return counts | {"Var": [float(f"{v:.4e}") for v in twentieths]}


def table(results: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows of all curves, numbers rounded so that they agree across processors."""
    rows = pd.DataFrame([row for result in results for row in result["rows"]])
    places = [f"percentile_{m}" for m in MEASURES]
    rows[RANKS] = rows[RANKS].astype(int)
    rows["Var"] = rows["Var"].map("{:.3e}".format)
    rows[places] = rows[places].astype(float).round(4)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m experiments.studies.to_disk", description=__doc__.split("\n")[0])
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
    results = compute("to_disk", parameters, names, partial(study, samples=arguments.samples))
    write_csv(RESULTS / "table_1_to_disk.csv", table(results))
    histograms = {name: value for result in results for name, value in result["histograms"].items()}
    write_json(RESULTS / "table_1_to_disk.json", {"parameters": parameters, "uniform": histograms})
    write_csv(RESULTS / "table_1_paper.csv", pd.DataFrame(PAPER))
    print(f"to_disk: {len(names)} curves -> results/table_1_to_disk.csv, results/table_1_to_disk.json")


if __name__ == "__main__":
    main()
