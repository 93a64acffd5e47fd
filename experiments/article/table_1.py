"""The two tables of the article about the paper's Table 1: to the disk, and from curve to curve."""

from pathlib import Path
from typing import Any

import pandas as pd

from experiments.claims.ledger import Numbers
from experiments.claims.table_1 import between_curves, to_the_disk
from experiments.measures import RANKS
from experiments.studies.curve_to_curve import DRAWS
from experiments.studies.grid import PARAMETERS as GRID
from experiments.subjects import PAPER

SETTINGS = [
    *((f"AR at {rank.removeprefix('AR_')}", rank, path, "time") for path in ("slide", "linear") for rank in RANKS),
    *((f"Var, pace {pace}", "Var", path, pace) for path in ("slide", "linear") for pace in ("time", "speed")),
]


def table_1(results: Path) -> dict[str, Any]:
    """What is found on the grid: curves by kind, remeshed against random, the law, and the paper's four columns."""
    x = Numbers(dict)
    shapes = pd.read_csv(results / "grid_shapes.csv").query("n == 96")
    fewer = to_the_disk(x, "AR_1e-9", "slide")
    law = pd.read_csv(results / "grid_law.csv").query("path == 'slide' and pace == 'time' and n == 96")
    fit = law[law.law == "slides"].set_index("rank").loc["AR_1e-9"]
    return {
        "grid_curves": len(shapes),
        "grid_added": int((~shapes.kind.isin(["constructed", "letter"])).sum()),
        "grid_samples": GRID["samples"],
        "layout_samples": DRAWS,
        "fewer": int(fewer.fewer.sum()),
        "not_fewer": int((~fewer.fewer).sum()),
        "fewer_most": f"{fewer.ratio[fewer.fewer].max():.1f}",
        "law_power": f"{fit.power:.2f}",
        "law_error": f"{100 * fit.factor_error:.0f} %",
        "law_without": f"{100 * fit.without_law:.0f} %",
        "to_disk": [disk_row(x, *setting) for setting in SETTINGS],
        "columns": columns(x),
        **settings(x),
    }


def disk_row(x: Numbers, word: str, measure: str, path: str, pace: str) -> list[str]:
    """On how many curves remeshed is smaller, equal, larger; median factors where fewer triangles slide, and else."""
    found = to_the_disk(x, measure, path, pace)
    counts = [(found.ratio > 1).sum(), (found.ratio == 1).sum(), (found.ratio < 1).sum()]
    return [path, word, *map(str, counts), *(f"{found.ratio[found.fewer == f].median():.2f}" for f in (True, False))]


def columns(x: Numbers) -> list[list[str]]:
    """The paper's columns: its ranks, its factors and ours, and how many settings of the grid come near."""
    rows = (1, 3, 4, 7)
    own, common = (pd.concat([between_curves(x, m, kind) for m in RANKS]) for kind in ("own", "common"))
    cells = x.table("grid_columns").groupby("row")[["cells", "both", "factor"]].sum()
    both = list(zip(PAPER["AR_remeshed"], PAPER["AR_arbitrary"], strict=True))
    changes = list(zip(PAPER["Var_remeshed"], PAPER["Var_arbitrary"], strict=True))
    return [
        ["AR of the paper, remeshed and arbitrary", *(f"{a} and {b}" for a, b in both)],
        ["factor, the paper", *(f"{b / a:.1f}" for a, b in both)],
        ["factor, ours, arbitrary ones flipped", *(spread(own, row) for row in rows)],
        ["factor, ours, arbitrary ones common to both curves", *(spread(common, row) for row in rows)],
        ["settings with both ranks within 20 %", *(f"{cells.both[r]} of {cells.cells[r]:,}" for r in rows)],
        ["settings with the factor within 20 %", *(f"{cells.factor[r]} of {cells.cells[r]:,}" for r in rows)],
        ["Var, factor, the paper", *(f"{b / a:.1f}" for a, b in changes)],
        ["Var, factor, ours, arbitrary ones flipped", *(spread(between_curves(x, "Var", "own"), row) for row in rows)],
    ]


def settings(x: Numbers) -> dict[str, Any]:
    """Of how many columns one setting gives both ranks, at most; who is the arbitrary one where row 1 comes near."""
    near = x.table("grid_cells").query("both > 0")
    first = x.table("grid_columns").query("row == 1").groupby("arbitrary").both.sum()
    alike = near.groupby(["n", "path", "pace", "frames", "arbitrary", "rank"]).row.nunique()
    return {
        "most_columns": int(alike.max()),
        "row_1_near": int(first.sum()),
        "row_1_split": int(first["first split"] + first["last split"]),
    }


def spread(ratios: "pd.Series[float]", row: int) -> str:
    """The least and the largest ratio of a row; nothing where there is none."""
    own = ratios[ratios.index.get_level_values("row") == row]
    low, high = (f"{r:.2g}" if r < 1000 else f"{float(f'{r:.2g}'):,.0f}" for r in (own.min(), own.max()))
    return f"{low} to {high}" if len(own) else "none"
