"""Tables as the report shows them: the ledger, Table 1, and a key table for each study."""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from experiments.catalogue import STUDIES, Step
from experiments.report.facts import against_median

NUMBER = re.compile(r"[-+<]?[\d.]+(e[-+]?\d+)?%?( (of|/) \d+)?|none|", re.IGNORECASE)


class Table(NamedTuple):
    """A table as it is shown: words in cells, and which columns hold numbers."""

    columns: list[str]
    rows: list[list[str]]
    numeric: list[bool]


def shown(frame: pd.DataFrame) -> Table:
    """The words of a frame, its index left out."""
    rows = [[_word(value) for value in row] for row in frame.itertuples(index=False)]
    numeric = [all(NUMBER.fullmatch(cell) for cell in column) for column in zip(*rows, strict=True)]
    return Table([str(column).replace("_", " ") for column in frame.columns], rows, numeric)


def _word(value: Any) -> str:
    if isinstance(value, float | np.floating):
        return "" if np.isnan(value) else f"{value:.4g}"
    return str(value).replace("_", " ")


def as_written(path: Path) -> pd.DataFrame:
    """A csv file, every cell as it stands there."""
    return pd.read_csv(path, dtype=str, keep_default_na=False)


def claims(results: Path) -> list[dict[str, str]]:
    """The rows of claims.csv; none where there is no such file."""
    path = results / "claims.csv"
    return as_written(path).to_dict("records") if path.exists() else []


def table_1(results: Path) -> dict[str, Any]:
    """Table 1 in the paper's layout: its columns, lines with X and Y for each, and the note below it."""
    table = as_written(results / "table_1.csv")
    columns = list(dict.fromkeys(re.sub(r" [XY]$", "", name) for name in table.columns[2:]))
    lines: list[dict[str, Any]] = []
    for measure, whose, *cells in table.itertuples(index=False):
        repeated = bool(lines) and lines[-1]["measure"] == measure
        pairs = [(X, _word(Y)) for X, Y in zip(cells[::2], cells[1::2], strict=True)]
        lines.append({"measure": measure, "repeated": repeated, "whose": whose, "pairs": pairs})
    note = (results / "table_1.md").read_text(encoding="utf-8").strip().split("\n")[-1]
    return {"columns": columns, "lines": lines, "note": note}


def key_to_disk(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file)
    places = [c for c in table if c.startswith("percentile_")]
    rows = []
    for path in ("slide", "linear"):
        medians = table[(table.path == path) & (table.triangulation == "remeshed")][places].median()
        for place, median in medians.items():
            measure = str(place).removeprefix("percentile_")
            counts = against_median(table, measure, path)
            row = {"path": path, "measure": measure, "percentile": round(median, 2)}
            rows.append(row | {key: counts[key] for key in ("below", "above")})
    return pd.DataFrame(rows)


def key_pairs(file: Path) -> pd.DataFrame:
    pairs = pd.read_csv(file)
    last = pairs[["u", "v"]].min(axis=1)
    gain = (last - pairs[["u_partial", "v_partial"]].min(axis=1)).round(5)
    counted = {
        "all": pairs.path.notna(),
        "a common triangulation": pairs.common != "none",
        "all flips possible at once": last < 1e-6,
        "the last flip after 0.95": last > 0.95,
        "flips done earlier where independent ones need not wait": gain > 0,
        "flips done later where independent ones need not wait": gain < 0,
        "all triangles positive": pairs.positive,
        "ends met within 1e-12": pairs["ends_within_1e-12"],
        "symmetric within 1e-9": pairs["symmetric_within_1e-9"],
    }
    return pd.DataFrame(counted).groupby(pairs.path).sum().T[["slide", "linear"]].rename_axis("pairs").reset_index()


def key_pivots(file: Path) -> pd.DataFrame:
    measures = ["crossings", "flips", "finish", "AR_1e-4", "Var"]
    return pd.read_csv(file).groupby("match", sort=False)[measures].median().reset_index()


def key_roots(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file).query("kind == 'rule' and set == 'curves' and percentile.notna()")
    wide = table.pivot(index=["path", "of"], columns="measure", values="percentile")
    return wide[list(table.measure.unique())].reset_index().rename(columns={"of": "root"})


def key_guarantee(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file)
    table["cell"] = table.valid.astype(str) + " of " + table.morphs.astype(str)
    table["guarantee"] = np.where(table.guarantee, "yes", "")
    wide = table.pivot(index=["path", "guarantee"], columns="kind", values="cell")[list(table.kind.unique())]
    return table[["path", "guarantee"]].drop_duplicates().merge(wide.reset_index())


def key_sensitivity(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file)
    table["cell"] = table.below.astype(str) + " / " + table.above.astype(str)
    rows = table[["factor", "setting"]].drop_duplicates()
    wide = table.pivot(index=["factor", "setting"], columns="measure", values="cell")
    return rows.merge(wide[["AR_1e-3", "AR_1e-4", "AR_1e-6", "AR_1e-9", "Var"]].reset_index())


def key_quality(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file)
    table = table[~table.scope.str.startswith("pairs: ") & table.measure.isin(["AR_1e-4", "Var"])]
    rows = zip(table.rho, table.low, table.high, strict=True)
    table = table.assign(cell=[f"{rho:.2f} ({low:.2f} to {high:.2f})" for rho, low, high in rows])
    wide = table.pivot(index=["scope", "quality"], columns="measure", values="cell").reset_index()
    return wide.rename(columns={"scope": "over", "quality": "goes with"})


# How the key table of a study is made from the first file that it writes.
KEYS: dict[str, Callable[[Path], pd.DataFrame]] = {
    "to_disk": key_to_disk,
    "sensitivity": key_sensitivity,
    "pairs": key_pairs,
    "pivots": key_pivots,
    "flip_distance": as_written,
    "roots": key_roots,
    "guarantee": key_guarantee,
    "quality": key_quality,
}


class KeyTable(NamedTuple):
    """A study as the report shows it; no table where its file is missing."""

    name: str
    title: str
    command: str
    about: str
    file: str
    table: Table | None


def key_tables(results: Path) -> list[KeyTable]:
    """The studies that have a key table."""
    found = []
    for study in STUDIES:
        if study.name in KEYS:
            file = study.results[0]
            table = shown(KEYS[study.name](results / file)) if (results / file).exists() else None
            found.append(KeyTable(study.name, study.title, study.command, about(study), file, table))
    return found


def about(study: Step) -> str:
    """What a study says of itself first."""
    return (importlib.import_module(f"experiments.{study.module}").__doc__ or "").strip().split("\n\n")[0]
