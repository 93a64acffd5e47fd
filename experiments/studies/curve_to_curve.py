"""Table 1 for pairs of curves: the four columns of the paper, Figure 11 rows 1, 3, 4 and 7, on our stand-ins.

X is the morph of the remeshed triangulations, along both of the paper's paths: pivots matched, flips in sequence where
they are not compatible.  Y are arbitrary triangulations under the same correspondence: where the two curves have
common triangulations, uniformly drawn ones, which need no flips; and in any case a uniformly drawn one for each
curve, flipped into each other on the way.  Writes results/table_1_curve_to_curve.csv.  All morphs, with flips and
without, are on one clock: vertices at constant root mean square speed; the grid (`.grid`) has the other clock, too.

Where the factors between X and Y come from, path "slide": the same triangulations morphed by way of the disk, where
each may be changed for any other, so that X goes as far as Y (results/table_1_curve_to_curve_ways.csv); and, for all
pairs of our curves that have one, a common triangulation beside the remeshed ones, which have to be flipped
(results/table_1_curve_to_curve_flips.csv).

200 draws for each pair, path and kind: the interval of a median of ranks is then one rank wide, about.
"""

import argparse
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import measures as table_1
from experiments.measures import PARAMETERS, QUANTILES, measures, percentile
from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.subjects import BETWEEN, PAPER, both, pairs
from tween import Morph, Triangulation, area_matrix, decompose, gallery, paper_morph
from tween.choices import Pace, Path
from tween.morphing.alignment import align, common
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.incompatible.flow import shared_edge
from tween.triangulating.compatibility import match_rows
from tween.triangulating.flips import flip_in_place

ROWS = (1, 3, 4, 7)
MEASURES = ["flips", *table_1.MEASURES]
PACE: Pace = "speed"
DRAWS, BATCH = 200, 50
WAYS = {"samples": 100, "frames": 101}  # over the disk: the disk is the 51st frame of both halves
PATHS: tuple[Path, ...] = ("slide", "linear")


def measure(m: Morph) -> list[float]:
    """Flips, AR at every tolerance, Var."""
    return [len(m.events), *measures(area_matrix(m, PARAMETERS["frames"]))]


def remeshed(name: str, path: Path = "slide") -> Morph:
    return paper_morph(*gallery.pair(name), path, pace=PACE)


def draw(part: str) -> dict[str, list[list[float]]]:
    """A batch of arbitrary triangulations of one pair, along one path: kind -> measures."""
    name, word, batch = part.split()
    path = next(path for path in PATHS if path == word)
    rng = rng_for(PARAMETERS["seed"], f"{name} {batch}")
    a = remeshed(name).alignment
    own = [decompose(T.curve).sample(rng, BATCH) for T in (a.source, a.target)]
    kinds = {"own": list(zip(*own, strict=True))}
    joint = decompose(a.source.curve, a.target.curve)
    if joint:
        kinds["common"] = [(S, Triangulation(a.target.points, S.triangles)) for S in joint.sample(rng, BATCH)]
    return {
        kind: [measure(paper_morph(S, T, path, shifts=0, pace=PACE)) for S, T in pairs] for kind, pairs in kinds.items()
    }


def rows_of(row: int, name: str, path: Path, drawn: dict[str, list[list[float]]]) -> list[dict[str, Any]]:
    """The rows of one column of the paper's table: remeshed, then the quantiles of the arbitrary ones."""
    m = remeshed(name, path)
    about = {"row": row, "pair": name, "n": len(m.source), "path": path, "pace": PACE}
    X = measure(m)
    rows: list[dict[str, Any]] = [about | {"triangulation": "remeshed"} | dict(zip(MEASURES, X, strict=True))]
    for kind, values in drawn.items():
        columns = np.array(values).T
        places = {f"percentile_{kind}_{m}": percentile(x, c) for m, x, c in zip(MEASURES, X, columns, strict=True)}
        rows[0] |= {key: round(p, 4) for key, p in places.items()}
        for label, q in QUANTILES.items():
            quantiles = np.quantile(columns, q, axis=1, method="inverted_cdf").tolist()
            rows.append(about | {"triangulation": f"{kind}_{label}"} | dict(zip(MEASURES, quantiles, strict=True)))
    return rows


def paper_row(row: int) -> dict[str, Any]:
    """What the paper prints for a row of Figure 11; its curves, units and tolerance are unpublished."""
    place = PAPER["curve"].index(f"Figure 11, row {row}")
    return {key: values[place] for key, values in PAPER.items() if key != "curve"}


def over_the_disk(S: Triangulation, T: Triangulation) -> NDArray[np.float64]:
    """Area matrix of the morph from S to the disk, and from the disk to T; at the disk one is flipped to the other."""
    disk, half = S.on_disk(), WAYS["frames"] // 2 + 1
    there = area_matrix(paper_morph(S, disk, shifts=0, pace=PACE), half)
    back = area_matrix(paper_morph(T, T.moved(disk.points), shifts=0, pace=PACE), half)
    back *= T.areas.sum() / S.areas.sum()
    return np.hstack([there, back[match_rows(T.triangles, flipped(disk, T.moved(disk.points))), -2::-1]])


def flipped(S: Triangulation, T: Triangulation) -> NDArray[np.int64]:
    """The triangles of one triangulation of a disk, in the rows that the other's hand down to them flip by flip."""
    triangles, twin = S.triangles.copy(), S.twin.copy()
    for t, u in flip_sequence(S, T).rows.tolist():
        flip_in_place(triangles, twin, shared_edge(twin, t, u))
    return triangles


def ways(name: str) -> dict[str, list[list[float]]]:
    """Remeshed and arbitrary triangulations of one pair, led over the disk: kind -> measures."""
    a = remeshed(name).alignment
    rng = rng_for(PARAMETERS["seed"], f"{name} over the disk")
    own = [decompose(T.curve).sample(rng, WAYS["samples"]) for T in (a.source, a.target)]
    led = {"remeshed": [(a.source, a.target)], "own": list(zip(*own, strict=True))}
    joint = decompose(a.source.curve, a.target.curve)
    if joint:
        led["common"] = [(S, Triangulation(a.target.points, S.triangles)) for S in joint.sample(rng, WAYS["samples"])]
    return {kind: [measures(over_the_disk(S, T)) for S, T in pairs] for kind, pairs in led.items()}


def table_of_ways(columns: pd.DataFrame, over: dict[tuple[int, str], dict[str, list[list[float]]]]) -> pd.DataFrame:
    """Medians by pair, way and kind of triangulation: straight or flipped, as in the columns, or over the disk."""
    rows = []
    for label, kind in (("remeshed", "remeshed"), ("own_median", "own"), ("common_median", "common")):
        for record in columns[(columns.triangulation == label) & (columns.path == "slide")].to_dict("records"):
            rows.append(record | {"way": "flipped" if record["flips"] else "straight", "triangulation": kind})
    for (row, name), kinds in over.items():
        for kind, values in kinds.items():
            medians = np.quantile(values, 0.5, axis=0, method="inverted_cdf")
            about = {"row": row, "pair": name, "way": "over the disk", "triangulation": kind}
            rows.append(about | dict(zip(table_1.MEASURES, medians, strict=True)))
    keys = ["row", "pair", "way", "triangulation"]
    return rounded(pd.DataFrame(rows)[[*keys, *table_1.MEASURES]].sort_values(keys, ignore_index=True))


def straight_and_flipped(pair: str) -> dict[str, Any] | None:
    """One pair under the pivots' correspondence: a common triangulation, and the remeshed ones; None if it has none."""
    source, target = both(pair)
    a = align(source, target)
    shared = common(a.source, a.target)
    if shared is None:
        return None
    straight = paper_morph(shared, Triangulation(a.target.points, shared.triangles), shifts=0, pace=PACE)
    by_flips = paper_morph(source, target, pace=PACE)
    row: dict[str, Any] = dict(zip(("source", "target"), pair.split(BETWEEN), strict=True))
    row["flips"] = len(by_flips.events)
    for label, m in (("straight", straight), ("flipped", by_flips)):
        row |= {f"{label}_{key}": value for key, value in zip(table_1.MEASURES, measure(m)[1:], strict=True)}
    return row


def rounded(table: pd.DataFrame) -> pd.DataFrame:
    """Ranks and flips as whole numbers, variances with four digits, so that they agree across processors."""
    for column in map(str, table):
        if column.startswith("p"):  # pair, path, pace, percentiles, the paper's
            continue
        if column == "flips" or "AR_" in column:
            table[column] = table[column].astype(int)
        elif column.endswith("Var"):
            table[column] = table[column].map("{:.3e}".format)
    return table


def columns(names: dict[int, str]) -> pd.DataFrame:
    """The four columns along both paths: remeshed, and the quantiles of the arbitrary ones."""
    batches = range(DRAWS // BATCH)
    parts = [f"{name} {path} {batch}" for name in names.values() for path in PATHS for batch in batches]
    results = dict(zip(parts, compute("curve_to_curve", PARAMETERS | {"draws": DRAWS}, parts, draw), strict=True))
    rows = []
    for path in PATHS:
        for row, name in names.items():
            drawn: dict[str, list[list[float]]] = {}
            for batch in batches:
                for kind, values in results[f"{name} {path} {batch}"].items():
                    drawn.setdefault(kind, []).extend(values)
            printed = {f"paper_{k}": v for k, v in paper_row(row).items()}
            rows += [r | printed for r in rows_of(row, name, path, drawn)]
    return pd.DataFrame(rows)


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.studies.curve_to_curve", description=__doc__.split("\n")[0]
    ).parse_args()
    names = {row: gallery.pairs()[row - 1] for row in ROWS}
    table = columns(names)
    write_csv(RESULTS / "table_1_curve_to_curve.csv", rounded(table.copy()))
    over = compute("curve_to_curve_ways", PARAMETERS | WAYS, list(names.values()), ways)
    write_csv(
        RESULTS / "table_1_curve_to_curve_ways.csv", table_of_ways(table, dict(zip(names.items(), over, strict=True)))
    )
    common = [row for row in compute("curve_to_curve_flips", PARAMETERS, pairs(), straight_and_flipped) if row]
    write_csv(RESULTS / "table_1_curve_to_curve_flips.csv", rounded(pd.DataFrame(common)))
    print(
        f"curve_to_curve: {len(ROWS)} columns of Table 1, {DRAWS} draws; {len(common)} pairs with and "
        "without flips -> results/table_1_curve_to_curve.csv, _ways.csv, _flips.csv"
    )


if __name__ == "__main__":
    main()
