"""Every number of the article, as it is written there, from the files of results/ and the parameters of the studies."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pandas as pd

from experiments.article.clauses import CLAUSES
from experiments.article.table_1 import table_1
from experiments.claims.ledger import CLAIM, QUESTION
from experiments.claims.rules import ORIGIN, RULES, TOGETHER, VERDICTS
from experiments.claims.shared import PARAMETERS as CLAIMS
from experiments.report.facts import facts as of_report
from experiments.report.references import REFERENCES
from experiments.report.tables import as_written
from experiments.store import ROOT
from experiments.studies.quality import PARAMETERS as QUALITY

SHOWN = {
    "AR_1e-4": "AR at 1e-4",
    "Var": "Var",
    "swelling": "swelling",
    "path_length": "length of paths, in widths",
}
PACKAGES = ("numpy", "numba", "scipy", "matplotlib")


def numbers(results: Path) -> dict[str, Any]:
    """All numbers and tables, by the names under which article.typ asks for them."""
    about = of_report(results)
    return {
        "curves": about["curves"],
        "constructed": about["constructed"],
        "letters": about["letters"],
        "pairs": about["pairs"],
        "common": about["common"],
        "draws": CLAIMS["draws"],
        "random": f"{QUALITY['random']:,}",
        "rules": RULES,
        "together": TOGETHER,
        "origin": ORIGIN,
        "references": REFERENCES,
        "versions": pinned(),
        "version": tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"],
        **ledger(results),
        **table_1(results),
        **guarantee(results),
        **matching(results),
        **sizes(results),
        **roots(results),
        **flips(results),
        **quality(results),
    }


def pinned() -> dict[str, str]:
    """The versions that the lock names, whatever this environment has: the same text everywhere."""
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    return {name: re.findall(rf"^{name}==([^ \n]+)", lock, re.MULTILINE)[0] for name in PACKAGES}


def ledger(results: Path) -> dict[str, Any]:
    """The verdicts counted, on claims and on open questions, and the rows of the table of both."""
    table = as_written(results / "claims.csv")
    claims = table[table.kind == CLAIM]

    def counted(column: pd.Series) -> dict[str, int]:
        return {verdict: int((column == verdict).sum()) for verdict in VERDICTS}

    return {
        "asked": len(claims),
        "verdicts": counted(claims.verdict),
        "as_printed": counted(claims.as_printed),
        "answers": counted(table[table.kind == QUESTION].verdict),
        "questions": int((table.kind == QUESTION).sum()),
        "claims": [ledger_row(row) for row in claims.to_dict("records")],
        "answered": [ledger_row(row) for row in table[table.kind == QUESTION].to_dict("records")],
    }


def ledger_row(row: dict[str, str]) -> dict[str, str]:
    """A row of the ledger for print: the cases as printed, the condition, and the cases that meet it."""
    parts = row["interval"].split("; ")
    under = [re.sub(r"^\[(?:condition\]: |(.*?)\])", r"\1", part) for part in parts if part.startswith("[")]
    return {
        "id": row["id"],
        "section": row["section"].split(" ")[0],
        "clause": CLAUSES[row["id"]],
        "as_printed": row["as_printed"],
        "cases": in_print([part for part in parts if not part.startswith("[")]),
        "condition": row["condition"].replace("`", ""),
        "under": in_print(under) if row["condition"] else "",
    }


def in_print(parts: list[str]) -> str:
    text = "; ".join(parts).replace("rho =", "ρ =")
    return re.sub(r" in \d+ groups", "", re.sub(r"(?<!e)-(?=\d)", "−", text))


def guarantee(results: Path) -> dict[str, Any]:
    """How many frames are checked, and how many fail, with the guarantee and without."""
    table = pd.read_csv(results / "guarantee_summary.csv")
    safe = table[table.guarantee.astype(bool)]
    plain = table[~table.guarantee.astype(bool)].set_index(["kind", "path"])
    failed = plain.morphs - plain.valid
    return {
        "safe_morphs": int(safe.groupby("path").morphs.sum().iloc[0]),
        "safe_paths": safe.path.nunique(),
        "safe_frames": f"{safe.frames.sum():,}",
        "safe_failed": int(safe.frames_failed.sum()),
        "random_disks": int(plain.morphs["random disk", "slide"]),
        "broken_linear": int(failed["random disk", "linear"]),
        "broken_slide": int(failed["random disk", "slide"]),
        "random_pairs": int(plain.morphs["random pair", "slide"]),
        "broken_pairs_linear": int(failed["random pair", "linear"]),
        "broken_pairs_slide": int(failed["random pair", "slide"]),
    }


def matching(results: Path) -> dict[str, Any]:
    """Medians as printed, with another path and placement, and matched; on how many pairs the matched one is better."""
    rows = pd.read_csv(results / "matching.csv")
    wide = rows.pivot(index=["source", "target"], columns="method")
    table = []
    for measure, word in SHOWN.items():
        own = wide[measure]
        medians = [short(own[method].median()) for method in ("paper", "paper_guaranteed", "matched")]
        table.append([word, *medians, f"{(own.matched < own.paper).sum()} : {(own.matched > own.paper).sum()}"])
    straight = rows[rows.method == "straight"]
    return {
        "printed_bad": int((wide.disks.paper < wide.disks.paper.max()).sum()),
        "matched_flips": int((wide.flips.matched > 0).sum()),
        "matching": table,
        "least_flips": int(wide.flips.paper.min()),
        "methods": rows.method.nunique(),
        "straight_bad": int((straight.disks < straight.disks.max()).sum()),
        "straight_AR": f"{straight['AR_1e-4'].median():.0f}",
    }


def short(value: float) -> str:
    """Two digits."""
    return f"{value:.2g}" if value > 0.01 else f"{value:.1e}".replace("e-0", "e-")


def sizes(results: Path) -> dict[str, Any]:
    """How shapes and their edges swell along slide, placed by the root and steadily."""
    slide = pd.read_csv(results / "pairs.csv").query("path == 'slide'")
    return {
        "swelling": f"{slide.swelling.median():.1f}",
        "swollen": int((slide.swelling > 1.01).sum()),
        "ten_fold": int((slide.swelling > 10).sum()),
        "longest": f"{slide.longest.median():.1f}",
        "longest_steady": f"{slide.longest_steady.median():.1f}",
        "shortest": f"{slide.shortest.median():.2f}",
        "shortest_steady": f"{slide.shortest_steady.median():.2f}",
    }


def roots(results: Path) -> dict[str, Any]:
    """The central root against the median root, placed steadily; and how it swells, placed by the root."""
    steady = pd.read_csv(results / "root_steady_summary.csv").set_index(["path", "measure"])
    wanted = [(path, measure) for path in ("slide", "linear") for measure in ("AR_1e-4", "Var")]
    rows = [(path, measure.replace("_", " at "), steady.loc[path, measure]) for path, measure in wanted]
    own = pd.read_csv(results / "roots_summary.csv").query(
        "set == 'curves' and path == 'slide' and of == 'disk-center'"
    )
    peak = own.set_index("measure").loc["area_max"]
    return {
        "roots": [
            [path, word, *(f"{r[c]:.0f}" for c in ("below_median", "above_median", "best")), f"{r.worst_over_best:.2f}"]
            for path, word, r in rows
        ],
        "root_swells_least": int(peak.best_quarter),
        "root_swells_most": int(peak.worst_quarter),
    }


def flips(results: Path) -> dict[str, Any]:
    """When the flips are finished, by order, as a share of the way to the disk."""
    slide = pd.read_csv(results / "flip_order_summary.csv").query("path == 'slide'").set_index("way")
    found = {f"flips_{order}": f"{slide['median'][order]:.2f}" for order in ("sequential", "partial", "greedy")}
    return found | {"flip_pairs": int(slide.pairs.iloc[0]), "flips_earlier": int(slide.earlier["greedy"])}


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
    found = {f"rho_{name}": f"{rho[key]:.2f}".replace("-", "−") for name, key in wanted.items()}
    return found | {f"search_{name}": f"{value:.2f}" for name, value in ratio.items()} | {"searched": len(search)}
