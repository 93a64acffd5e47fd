"""Everything on one page: `python -m experiments.report` writes results/report.html.

The page needs nothing beside itself: its figures are embedded, and it has neither scripts nor addresses to fetch.
This module gathers the numbers, from results/ only; report.html.j2 has the words, report.css the looks.
"""

import base64
import importlib
import importlib.metadata
import io
import json
import os
import pkgutil
import platform
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import jinja2
import nbformat
import numpy as np
import pandas as pd
from markupsafe import Markup, escape
from PIL import Image

import experiments
from experiments.figures.registry import SEED
from experiments.reproduce import TIMES
from experiments.store import RESULTS, ROOT, write_text

HERE = Path(__file__).parent
# What the page cannot do without, and the study that writes it; other results are shown where there are any.
NEEDED = {
    "figures/captions.json": "figures",
    "table1.csv": "table1",
    "table1.json": "table1",
    "table1_columns.csv": "figure11",
    "table_1.csv": "table1_formats",
    "table_1.md": "table1_formats",
    "pairs.csv": "pairs",
    "pivots.csv": "pivots",
    "flips.csv": "flips",
}
NUMBER = re.compile(r"[-+<]?[\d.]+(e[-+]?\d+)?%?( (of|/) \d+)?|none|", re.IGNORECASE)


class MissingResultsError(Exception):
    """Results that the page needs are not there; the message says how to get them."""


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


# The abstract


def facts(results: Path) -> dict[str, Any]:
    """The numbers of the abstract."""
    table = pd.read_csv(results / "table1.csv")
    pairs = pd.read_csv(results / "pairs.csv").query("path == 'slide'")
    kinds = table.groupby("kind").curve.nunique()
    return {
        "samples": json.loads((results / "table1.json").read_text(encoding="utf-8"))["parameters"]["samples"],
        "curves": int(kinds.sum()),
        "constructed": int(kinds["constructed"]),
        "letters": int(kinds["letter"]),
        "loose": against_median(table, "AR_1e-4", "slide"),
        "tight": against_median(table, "AR_1e-9", "slide"),
        "var": against_median(table, "Var", "slide"),
        "columns": factors(pd.read_csv(results / "table1_columns.csv")),
        "pairs": len(pairs),
        "common": int((pairs.common != "none").sum()),
        "late": int((pairs[["u", "v"]].min(axis=1) > 0.95).sum()),
        "guarantee": guaranteed(results / "guarantee_summary.csv"),
    }


def against_median(table: pd.DataFrame, measure: str, path: str) -> dict[str, Any]:
    """On how many curves the remeshed triangulation is below, and above, the median of the random ones; by how much."""
    wide = table[table.path == path].pivot(index="curve", columns="triangulation", values=measure)
    gap = wide.uniform_median - wide.remeshed
    return {"below": int((gap > 0).sum()), "above": int((gap < 0).sum()), "gap": f"{gap.median():g}"}


def factors(columns: pd.DataFrame) -> list[dict[str, Any]]:
    """AR of arbitrary over AR of remeshed, ours and the paper's, for each column of Table 1."""
    found = []
    for row, part in columns.groupby("row"):
        by = part.set_index("triangulation")
        ours = by.loc["own_median", "AR_1e-4"] / by.loc["remeshed", "AR_1e-4"]
        paper = by.paper_AR_arbitrary.iloc[0] / by.paper_AR_remeshed.iloc[0]
        compatible = bool(by.loc["remeshed", "flips"] == 0)
        found.append({"row": row, "ours": f"{ours:.1f}", "paper": f"{paper:.1f}", "compatible": compatible})
    return found


def guaranteed(path: Path) -> dict[str, int] | None:
    """How many morphs along the paper's two paths leave the immersed disks, without and with the guarantee."""
    if not path.exists():
        return None
    table = pd.read_csv(path).query("path in ['linear', 'slide']")
    sums = table.groupby("guarantee")[["morphs", "valid"]].sum()
    failed = sums.morphs - sums.valid
    return {"morphs": int(sums.morphs[False]), "plain": int(failed[False]), "safe": int(failed[True])}


# Tables


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


def key_table1(file: Path) -> pd.DataFrame:
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
    gain = (pairs[["u_sequential", "v_sequential"]].min(axis=1) - last).round(5)
    counted = {
        "all": pairs.path.notna(),
        "a common triangulation": pairs.common != "none",
        "all flips possible at once": last < 1e-6,
        "the last flip after 0.95": last > 0.95,
        "flips done earlier than in sequence": gain > 0,
        "flips done later than in sequence": gain < 0,
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


# The file that a study's key table is made from, and how.
KEYS: dict[str, tuple[str, Callable[[Path], pd.DataFrame]]] = {
    "table1": ("table1.csv", key_table1),
    "sensitivity": ("sensitivity.csv", key_sensitivity),
    "pairs": ("pairs.csv", key_pairs),
    "pivots": ("pivots.csv", key_pivots),
    "flips": ("flips.csv", as_written),
    "roots": ("roots_summary.csv", key_roots),
    "guarantee": ("guarantee_summary.csv", key_guarantee),
}


def key_tables(results: Path) -> dict[str, Table | None]:
    """The key table of each study; None where its file is missing."""
    files = {name: (results / file, make) for name, (file, make) in KEYS.items()}
    return {name: shown(make(file)) if file.exists() else None for name, (file, make) in files.items()}


# Figures and notebooks


def figures(results: Path) -> list[dict[str, Any]]:
    """The figures in the paper's order, ours last, each with its picture."""
    captions = json.loads((results / "figures" / "captions.json").read_text(encoding="utf-8"))
    found = [{"name": name} | about | embedded(results / "figures" / f"{name}.png") for name, about in captions.items()]
    return sorted(found, key=lambda figure: (*paper_order(figure["of"]), figure["name"]))


def paper_order(of: str) -> tuple[int, int]:
    kinds = ["Figure", "Table", "Section"]
    rank = next((i for i, kind in enumerate(kinds) if of.startswith(kind)), len(kinds))
    return rank, int((re.findall(r"\d+", of) or [0])[0])


def embedded(path: Path) -> dict[str, Any]:
    """A picture as a data URI, in WebP, which loses nothing and takes half the room of PNG; and its size."""
    if not path.exists():
        raise MissingResultsError(f"results/figures/{path.name} is missing: run `python -m experiments.figures`")
    packed = io.BytesIO()
    with Image.open(path) as picture:
        picture.convert("RGB").save(packed, "WEBP", lossless=True, method=1)
        width, height = picture.size
    uri = f"data:image/webp;base64,{base64.b64encode(packed.getvalue()).decode()}"
    return {"uri": uri, "width": width, "height": height}


def notebooks() -> list[dict[str, Any]]:
    """Each notebook with its title and what its first cell says about its place in the paper."""
    found = []
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        title, _, rest = nbformat.read(path, as_version=4).cells[0].source.partition("\n")
        found.append({"name": path.name, "title": title.lstrip("# "), "places": places(rest)})
    return found


def places(text: str) -> set[str]:
    """Every section, figure and table that a text names: "Figures 1 to 3 and 5" are four."""
    number = r"\d+(?:\.\d+)*"
    named = re.findall(rf"(Section|Figure|Table)s? ({number}(?:(?:, and |, | and | to ){number})*)", text)
    found = set()
    for kind, numbers in named:
        for first, last in re.findall(rf"({number})(?: to (\d+))?", numbers):
            found |= {f"{kind} {n}" for n in range(int(first), int(last) + 1)} if last else {f"{kind} {first}"}
    return found


# How it was made


def parameters() -> dict[str, dict[str, Any]]:
    """PARAMETERS of every module of experiments that has some."""
    found: dict[str, dict[str, Any]] = {"figures": {"seed": SEED}}
    for module in pkgutil.iter_modules(experiments.__path__):
        if not module.ispkg:
            found[module.name] = getattr(importlib.import_module(f"experiments.{module.name}"), "PARAMETERS", {})
    return {name: values for name, values in sorted(found.items()) if values}


def about(study: str) -> str:
    """What a study says of itself first; nothing where there is no such study."""
    if not (HERE / f"{study}.py").exists():
        return ""
    return (importlib.import_module(f"experiments.{study}").__doc__ or "").strip().split("\n\n")[0]


def versions() -> dict[str, str]:
    """Python, and every package that the project asks for, with its version."""
    names = [re.split(r"[^\w.-]", line)[0] for line in importlib.metadata.requires("tween") or []]
    found = {"Python": platform.python_version(), "tween": importlib.metadata.version("tween")}
    for name in sorted(set(names) - {"tween"}, key=str.lower):
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


# The page


def check(results: Path) -> None:
    """Raise where something that the page needs is missing, naming every study to run."""
    missing = {file: study for file, study in NEEDED.items() if not (results / file).exists()}
    if missing:
        files = ", ".join(f"results/{file}" for file in missing)
        commands = "; ".join(f"python -m experiments.{study}" for study in dict.fromkeys(missing.values()))
        raise MissingResultsError(f"missing {files}: run `{commands}`, or `make reproduce` for everything")


def prose(text: str) -> Markup:
    """Text as HTML: `names` set as code, and numbers such as 1e-4 in one piece."""
    whole = re.sub(r"(\d+e-\d+)", r'<span class="nowrap">\1</span>', str(escape(text)))
    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", whole))


def breakable(name: str) -> Markup:
    """A long name with places where its line may break."""
    return Markup(re.sub(r"(::|/|_)", r"\1<wbr>", str(escape(name))))


def page(results: Path = RESULTS, times: Path = TIMES) -> str:
    """The whole page."""
    check(results)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"prose": prose, "breakable": breakable, "places": places}
    return environment.get_template("report.html.j2").render(
        style=Markup((HERE / "report.css").read_text(encoding="utf-8")),
        facts=facts(results),
        claims=claims(results),
        table_1=table_1(results),
        keys=key_tables(results),
        files={name: file for name, (file, _) in KEYS.items()},
        figures=figures(results),
        notebooks=notebooks(),
        parameters=parameters(),
        about=about,
        versions=versions(),
        machine=f"{platform.system()} on {platform.machine()}, {os.cpu_count()} cores",
        times=json.loads(times.read_text(encoding="utf-8")) if times.exists() else [],
        is_file=lambda name: (ROOT / name).is_file(),
    )


def main(results: Path = RESULTS) -> int:
    try:
        text = page(results)
    except MissingResultsError as error:
        print(f"report: {error}", file=sys.stderr)
        return 1
    target = results / "report.html"
    write_text(target, text)
    absent = [name for name, (file, _) in KEYS.items() if not (results / file).exists()]
    if absent:
        print(f"report: not yet run, so left out: {', '.join(absent)}")
    print(f"report: {len(text.encode()) / 1e6:.1f} MB, open {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
