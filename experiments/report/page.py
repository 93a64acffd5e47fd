"""The page, which needs nothing beside itself: its figures are embedded, and there are no scripts.

This folder gathers the numbers, from results/ only; the templates have the words, report.css the looks.
"""

import base64
import io
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
import nbformat
from markupsafe import Markup, escape
from PIL import Image

from experiments.catalogue import STUDIES, writer
from experiments.claims.rules import ORIGIN, RULES, TOGETHER
from experiments.figures.everything import DRAWINGS
from experiments.report.facts import facts
from experiments.report.made import machine, parameters, versions
from experiments.report.references import REFERENCES
from experiments.report.tables import claims, key_tables, table_1
from experiments.reproduce import TIMES
from experiments.store import RESULTS, ROOT

HERE = Path(__file__).parent
# What the page cannot do without; other results are shown where there are any.
NEEDED = (
    "figures/captions.json",
    "table_1_to_disk.csv",
    "table_1_to_disk.json",
    "table_1_curve_to_curve.csv",
    "table_1.csv",
    "table_1.md",
    "grid_shapes.csv",
    "pairs.csv",
    "pivots.csv",
    "flip_distance.csv",
)


class MissingResultsError(Exception):
    """Results that the page needs are not there; the message says how to get them."""


# Figures and notebooks


def figures(results: Path) -> list[dict[str, Any]]:
    """The figures in the paper's order, ours last, each with its picture and the code that draws it."""
    captions = json.loads((results / "figures" / "captions.json").read_text(encoding="utf-8"))
    found = [
        {"name": name, "code": code_of(name)} | about | embedded(results / "figures" / f"{name}.png")
        for name, about in captions.items()
    ]
    return sorted(found, key=lambda figure: (*paper_order(figure["of"]), figure["name"]))


def code_of(figure: str) -> str:
    """The file that draws a figure, in the project."""
    return Path(DRAWINGS[figure].make.__code__.co_filename).relative_to(ROOT).as_posix()


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


# The page


def check(results: Path) -> None:
    """Raise where something that the page needs is missing, naming every study to run."""
    missing = [file for file in NEEDED if not (results / file).exists()]
    if missing:
        files = ", ".join(f"results/{file}" for file in missing)
        commands = "; ".join(dict.fromkeys(writer(file).command for file in missing))
        raise MissingResultsError(f"missing {files}: run `{commands}`, or `make reproduce` for everything")


def prose(text: str) -> Markup:
    """Text as HTML: `names` set as code, and numbers such as 1e-4 in one piece."""
    whole = re.sub(r"(\d+e-\d+)", r'<span class="nowrap">\1</span>', str(escape(text)))
    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", whole))


def breakable(name: str) -> Markup:
    """A long name with places where its line may break."""
    return Markup(re.sub(r"(::|/|_)", r"\1<wbr>", str(escape(name))))


def own_figures(studies: Sequence[str]) -> set[str]:
    """The figures about some studies alone."""
    return {figure for study in STUDIES if study.name in studies for figure in study.figures}


def page(results: Path = RESULTS, times: Path = TIMES) -> str:
    """The whole page."""
    check(results)
    return (
        templates()
        .get_template("page.html.j2")
        .render(
            style=Markup((HERE / "report.css").read_text(encoding="utf-8")),
            facts=facts(results),
            claims=claims(results),
            table_1=table_1(results),
            studies=key_tables(results),
            figures=figures(results),
            own_figures=own_figures,
            rules=RULES,
            together=TOGETHER,
            origin=ORIGIN,
            references=list(REFERENCES.values()),
            notebooks=notebooks(),
            parameters=parameters(),
            versions=versions(),
            machine=machine(),
            times=json.loads(times.read_text(encoding="utf-8")) if times.exists() else [],
            is_file=lambda name: (ROOT / name).is_file(),
        )
    )


def templates() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"prose": prose, "breakable": breakable, "places": places}
    return environment
