"""The numbers of the report's abstract."""

import json
from pathlib import Path
from typing import Any

import pandas as pd
from scipy.stats import binomtest


def facts(results: Path) -> dict[str, Any]:
    """The numbers of the abstract."""
    table = pd.read_csv(results / "table_1_to_disk.csv")
    pairs = pd.read_csv(results / "pairs.csv").query("path == 'slide'")
    kinds = table.groupby("kind").curve.nunique()
    return {
        "samples": json.loads((results / "table_1_to_disk.json").read_text(encoding="utf-8"))["parameters"]["samples"],
        "curves": int(kinds.sum()),
        "constructed": int(kinds["constructed"]),
        "letters": int(kinds["letter"]),
        "loose": against_median(table, "AR_1e-4", "slide"),
        "tight": against_median(table, "AR_1e-9", "slide"),
        "var": against_median(table, "Var", "slide"),
        "columns": factors(pd.read_csv(results / "table_1_curve_to_curve.csv")),
        "pairs": len(pairs),
        "added": added(results / "grid_shapes.csv"),
        "common": int((pairs.common != "none").sum()),
        "late": int((pairs[["u", "v"]].min(axis=1) > 0.95).sum()),
        "guarantee": guaranteed(results / "guarantee_summary.csv"),
        "printed_bad": printed_bad(results / "matching.csv"),
    }


def added(path: Path) -> int:
    """How many curves, from fat to thin, were added for Table 1."""
    kinds = pd.read_csv(path).drop_duplicates("curve").kind
    return int((~kinds.isin(["constructed", "letter"])).sum())


def against_median(table: pd.DataFrame, measure: str, path: str) -> dict[str, Any]:
    """On how many curves the remeshed triangulation is below, and above, the median of the random ones; by how much."""
    wide = table[table.path == path].pivot(index="curve", columns="triangulation", values=measure)
    gap = wide.uniform_median - wide.remeshed
    below, above = int((gap > 0).sum()), int((gap < 0).sum())
    test = binomtest(below, below + above).pvalue if below + above else 1.0
    return {"below": below, "above": above, "gap": f"{gap.median():g}", "p": f"{test:.2g}"}


def factors(columns: pd.DataFrame) -> list[dict[str, Any]]:
    """AR of arbitrary over AR of remeshed, ours and the paper's, for each column of Table 1."""
    found = []
    for row, part in columns[columns.path == "linear"].groupby("row"):
        by = part.set_index("triangulation")
        ours = by.loc["own_median", "AR_1e-4"] / by.loc["remeshed", "AR_1e-4"]
        paper = by.paper_AR_arbitrary.iloc[0] / by.paper_AR_remeshed.iloc[0]
        compatible = bool(by.loc["remeshed", "flips"] == 0)
        found.append({"row": row, "ours": f"{ours:.1f}", "paper": f"{paper:.1f}", "compatible": compatible})
    return found


def printed_bad(path: Path) -> int | None:
    """How many pairs of curves, morphed as printed, have a frame that bounds no disk."""
    if not path.exists():
        return None
    disks = pd.read_csv(path).query("method == 'paper'").disks
    return int((disks < disks.max()).sum())


def guaranteed(path: Path) -> dict[str, int] | None:
    """How many morphs along the paper's two paths leave the immersed disks, without and with the guarantee."""
    if not path.exists():
        return None
    table = pd.read_csv(path).query("path in ['linear', 'slide']")
    sums = table.groupby("guarantee")[["morphs", "valid"]].sum()
    failed = sums.morphs - sums.valid
    return {"morphs": int(sums.morphs[False]), "plain": int(failed[False]), "safe": int(failed[True])}
