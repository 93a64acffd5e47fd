"""Every number of the article, as it is written there, from the files of results/."""

import re
from pathlib import Path
from typing import Any

import pandas as pd

from experiments.claims.rules import RULES, TOGETHER, VERDICTS
from experiments.report.facts import facts as of_report
from experiments.report.references import REFERENCES
from experiments.report.tables import as_written
from experiments.store import ROOT

SHOWN = {"AR_1e-4": "AR at 1e-4", "Var": "Var", "swelling": "swelling", "path_length": "length of paths"}
TABLE_1 = (
    "smaller-rank-to-the-disk",
    "smaller-variance-to-the-disk",
    "smaller-rank-between-curves",
    "smaller-variance-between-curves",
)
PACKAGES = ("numpy", "numba", "scipy", "matplotlib")


def numbers(results: Path) -> dict[str, Any]:
    """All numbers and tables, by the names under which article.typ asks for them."""
    claims = as_written(results / "claims.csv")
    about = of_report(results)
    return {
        "curves": about["curves"],
        "constructed": about["constructed"],
        "letters": about["letters"],
        "samples": f"{about['samples']:,}",
        "pairs": about["pairs"],
        "common": about["common"],
        "verdicts": {verdict: int((claims.verdict == verdict).sum()) for verdict in VERDICTS},
        "claims": claims.to_dict("records"),
        "found": dict(zip(claims.id, claims.number, strict=True)),
        "table_1": [claims[claims.id == name].iloc[0].to_dict() for name in TABLE_1],
        "rules": RULES,
        "together": TOGETHER,
        "references": REFERENCES,
        "versions": pinned(),
        **guarantee(results),
        **matching(results),
        **sizes(results),
        **quality(results),
    }


def pinned() -> dict[str, str]:
    """The versions that the lock names, whatever this environment has: the same text everywhere."""
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    return {name: re.findall(rf"^{name}==([^ \n]+)", lock, re.MULTILINE)[0] for name in PACKAGES}


def guarantee(results: Path) -> dict[str, Any]:
    """How many frames are checked, and how many fail, with the guarantee and without."""
    table = pd.read_csv(results / "guarantee_summary.csv")
    safe = table[table.guarantee.astype(bool)]
    plain = table[~table.guarantee.astype(bool)].set_index(["kind", "path"])
    failed = plain.morphs - plain.valid
    return {
        "safe_frames": f"{safe.frames.sum():,}",
        "safe_failed": int(safe.frames_failed.sum()),
        "random_disks": int(plain.morphs["random disk", "slide"]),
        "broken_linear": int(failed["random disk", "linear"]),
        "broken_slide": int(failed["random disk", "slide"]),
    }


def matching(results: Path) -> dict[str, Any]:
    """Medians as printed and matched, and on how many pairs the matched morph is better."""
    rows = pd.read_csv(results / "matching.csv")
    wide = rows[rows.method.isin(["paper", "matched"])].pivot(index=["source", "target"], columns="method")
    table = []
    for measure, word in SHOWN.items():
        paper, matched = wide[measure].paper, wide[measure].matched
        share = f"{(matched < paper).sum()} : {(matched > paper).sum()}"
        table.append([word, f"{paper.median():.3g}", f"{matched.median():.3g}", share])
    return {
        "printed_bad": int((wide.disks.paper < wide.disks.paper.max()).sum()),
        "matched_flips": int((wide.flips.matched > 0).sum()),
        "matching": table,
        "straight_bad": int((rows[rows.method == "straight"].disks < 61).sum()),
        "straight_AR": f"{rows[rows.method == 'straight']['AR_1e-4'].median():.0f}",
    }


def sizes(results: Path) -> dict[str, Any]:
    """How shapes and their edges swell along slide, placed by the root and steadily."""
    slide = pd.read_csv(results / "pairs.csv").query("path == 'slide'")
    steady = pd.read_csv(results / "root_steady_summary.csv").query("path == 'slide' and measure == 'Var'").iloc[0]
    return {
        "swelling": f"{slide.swelling.median():.1f}",
        "swollen": int((slide.swelling > 1.01).sum()),
        "ten_fold": int((slide.swelling > 10).sum()),
        "longest": f"{slide.longest.median():.1f}",
        "longest_steady": f"{slide.longest_steady.median():.1f}",
        "shortest": f"{slide.shortest.median():.2f}",
        "shortest_steady": f"{slide.shortest_steady.median():.2f}",
        "root_below": int(steady.below_median),
        "root_above": int(steady.above_median),
    }


def quality(results: Path) -> dict[str, Any]:
    """What AR and Var go with, and what the search for the least Var finds, over the remeshed triangulation."""
    rho = pd.read_csv(results / "quality.csv").set_index(["scope", "measure", "quality"]).rho
    search = pd.read_csv(results / "quality_search.csv").pivot(index="curve", columns="triangulation")
    ratio = {
        m: (search[m]["Var, search from best random"] / search[m]["remeshed"]).median()
        for m in ("Var", "energy", "swelling", "path_length")
    }
    pair, curve = "methods of one pair", "triangulations of one curve"
    wanted = {
        "AR_paths": (pair, "AR_1e-4", "path_length"),
        "AR_swelling": (pair, "AR_1e-4", "swelling"),
        "AR_invalid": (pair, "AR_1e-4", "invalid"),
        "Var_paths": (pair, "Var", "path_length"),
        "Var_swelling": (pair, "Var", "swelling"),
        "Var_invalid": (pair, "Var", "invalid"),
        "Var_swelling_curve": (curve, "Var", "swelling"),
        "Var_energy_curve": (curve, "Var", "energy"),
        "AR_swelling_curve": (curve, "AR_1e-4", "swelling"),
        "AR_energy_curve": (curve, "AR_1e-4", "energy"),
    }
    found = {f"rho_{name}": f"{rho[key]:.2f}" for name, key in wanted.items()}
    return found | {f"search_{name}": f"{value:.2f}" for name, value in ratio.items()} | {"searched": len(search)}
