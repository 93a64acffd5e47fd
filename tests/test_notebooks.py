"""The notebooks: run from top to bottom, each says what it is about, leaves nothing unchecked, reads what is there.

That their outputs come out again is checked by nbval.
"""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
import pytest

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
# Their outputs are compared strictly; those of later notebooks are not.
STRICT = [path for path in NOTEBOOKS if re.match(r"0[0-8]_", path.name)]
# What tells nbval not to compare a cell, as a comment or, in lower case with hyphens, as a tag.
MARKS = ("NBVAL_IGNORE_OUTPUT", "NBVAL_SKIP", "NBVAL_RAISES_EXCEPTION", "PYTEST_VALIDATE_IGNORE_OUTPUT")
TAGS = {"raises-exception", *(mark.lower().replace("_", "-") for mark in MARKS)}
MOST_UNCHECKED = 3
REASON = re.compile(r"\bnot\s+(be\s+)?(compared|checked)\b", re.IGNORECASE)
READERS = {"Image", "SVG", "open", "read_csv", "read_json", "imread", "load", "Path"}


def cells_of(path: Path) -> list[Any]:
    """Return the cells of a notebook."""
    return list(nbformat.read(path, as_version=4).cells)


# That it was run


def execution_faults(path: Path) -> list[str]:
    """Name each code cell that was not run in its turn, failed, or lost its picture; nbval lets all of them pass."""
    cells = [cell for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
    faults = [] if cells else ["no code cell"]
    for number, cell in enumerate(cells, start=1):
        count, outputs = cell["execution_count"], cell["outputs"]
        if count != number:
            faults.append(f"code cell {number} has execution count {count}")
        if any(output["output_type"] == "error" for output in outputs):
            faults.append(f"code cell {number} failed")
        if "plt.show()" in "".join(cell["source"]) and not any("image/png" in o.get("data", {}) for o in outputs):
            faults.append(f"code cell {number} shows a figure but holds no picture")
    return faults


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_every_notebook_was_run_from_top_to_bottom(path: Path) -> None:
    assert execution_faults(path) == []


def sound_cells() -> list[dict[str, Any]]:
    """Return the cells of a notebook that is as it should be."""
    picture = {"output_type": "display_data", "data": {"image/png": ""}}
    return [
        {"cell_type": "markdown", "source": ["# Title"]},
        {"cell_type": "code", "source": ["x = 1"], "execution_count": 1, "outputs": []},
        {"cell_type": "code", "source": ["draw(x)\n", "plt.show()"], "execution_count": 2, "outputs": [picture]},
    ]


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({}, []),
        ({"execution_count": None}, ["code cell 2 has execution count None"]),
        ({"execution_count": 1}, ["code cell 2 has execution count 1"]),
        ({"outputs": []}, ["code cell 2 shows a figure but holds no picture"]),
        ({"outputs": [{"output_type": "error"}], "source": ["1 / 0"]}, ["code cell 2 failed"]),
    ],
)
def test_a_doctored_notebook_is_seen(tmp_path: Path, change: dict[str, Any], fault: list[str]) -> None:
    cells = sound_cells()
    cells[-1] |= change
    path = tmp_path / "doctored.ipynb"
    path.write_text(json.dumps({"cells": cells}))
    assert execution_faults(path) == fault


def test_a_notebook_without_code_is_seen(tmp_path: Path) -> None:
    path = tmp_path / "empty.ipynb"
    path.write_text(json.dumps({"cells": []}))
    assert execution_faults(path) == ["no code cell"]


# What it is about


def title_fault(cells: list[Any], needs_place: bool = True) -> str:
    """Say what the first cell lacks: a title, or the place in the paper."""
    if not cells or cells[0].cell_type != "markdown" or not cells[0].source.startswith("# "):
        return "the first cell is no title"
    if not needs_place:
        return ""
    _, _, rest = cells[0].source.partition("\n")
    named = re.search(r"\b(Abstract|all sections|(Sections?|Figures?|Table|Algorithm) \d)", rest)
    return "" if named else "the first cell does not name the paper's section below its title"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_starts_with_its_title_and_its_place_in_the_paper(path: Path) -> None:
    assert title_fault(cells_of(path), needs_place=path in STRICT) == ""


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_says_nothing_on_stderr(path: Path) -> None:
    outputs = [output for cell in cells_of(path) for output in cell.get("outputs", [])]
    assert [output.text for output in outputs if output.get("name") == "stderr"] == []


# What nbval is told to leave alone


def is_unchecked(cell: Any) -> bool:
    """Say whether nbval is told not to compare what a cell puts out."""
    comments = {line.strip().lstrip("#").strip() for line in cell.source.splitlines() if line.strip().startswith("#")}
    return cell.cell_type == "code" and bool(comments & set(MARKS) or TAGS & set(cell.metadata.get("tags", [])))


def reason_faults(cells: list[Any]) -> list[str]:
    """Name each unchecked cell without a text beside it that says why it is not compared."""
    faults = []
    for i, cell in enumerate(cells):
        beside = [c for c in (*cells[max(i - 1, 0) : i], *cells[i + 1 : i + 2]) if c.cell_type == "markdown"]
        if is_unchecked(cell) and not any(REASON.search(c.source) for c in beside):
            faults.append(f"cell {i} is not compared, and no text beside it says that it is not compared, and why")
    return faults


@pytest.mark.parametrize("path", STRICT, ids=lambda path: path.stem)
def test_an_output_that_is_not_compared_has_its_reason_beside_it(path: Path) -> None:
    assert reason_faults(cells_of(path)) == []


def test_few_outputs_are_not_compared() -> None:
    unchecked = [f"{path.stem}: {cell.source}" for path in STRICT for cell in cells_of(path) if is_unchecked(cell)]
    assert len(unchecked) <= MOST_UNCHECKED, unchecked


# What it reads


def literal(node: ast.expr) -> str | None:
    """Return a string that stands in the code, with a star for whatever an f-string fills in."""
    if isinstance(node, ast.JoinedStr):
        parts = (literal(value) if isinstance(value, ast.Constant) else "*" for value in node.values)
        return "".join(part or "" for part in parts)
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def paths_read(source: str) -> Iterator[str]:
    """Yield each path that the code spells out: what readers are given, and whatever leads out of the folder."""
    nodes = list(ast.walk(ast.parse(source)))
    pieces = {id(value) for node in nodes if isinstance(node, ast.JoinedStr) for value in node.values}
    for node in nodes:
        if isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in READERS:
            yield from (text for text in map(literal, node.args[:1]) if text is not None)
        elif isinstance(node, ast.Constant | ast.JoinedStr) and id(node) not in pieces:
            yield from (text for text in [literal(node)] if text and text.startswith("../"))


def path_faults(source: str) -> list[str]:
    """Name each path outside results/, or to nothing."""
    faults = []
    for text in sorted(set(paths_read(source))):
        if not re.match(r"\.\./results(/|$)", text):
            faults.append(f"{text} is not in results/")
        elif not list(FOLDER.glob(text)):
            faults.append(f"{text} does not exist")
    return faults


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_reads_only_results_that_exist(path: Path) -> None:
    assert [fault for cell in cells_of(path) if cell.cell_type == "code" for fault in path_faults(cell.source)] == []


def link_faults(source: str) -> list[str]:
    """Name each link and picture of a text that leads nowhere."""
    links = re.findall(r"\]\(([^)#\s]+)", source)
    return [f"{link} does not exist" for link in links if ":" not in link and not (FOLDER / link).exists()]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_links_and_pictures_of_a_notebook_exist(path: Path) -> None:
    assert [
        fault for cell in cells_of(path) if cell.cell_type == "markdown" for fault in link_faults(cell.source)
    ] == []


def unexplained(cells: list[Any]) -> list[str]:
    """Name each stored figure that is shown without a link to the code that draws it, in the text before it."""
    faults, link = [], False
    for cell in cells:
        if cell.cell_type == "markdown":
            link = "](../experiments/figures/" in cell.source
        elif 'Image("../results/figures/' in cell.source and not link:
            faults.append(cell.source.splitlines()[-1])
    return faults


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_stored_figure_has_a_link_to_the_code_that_draws_it(path: Path) -> None:
    assert unexplained(cells_of(path)) == []


@pytest.mark.parametrize("path", NOTEBOOKS[:-1], ids=lambda path: path.stem)
def test_a_notebook_leads_to_the_next(path: Path) -> None:
    following = NOTEBOOKS[NOTEBOOKS.index(path) + 1]
    title = cells_of(following)[0].source.splitlines()[0].removeprefix("# ")
    assert f"Next: [{title}]({following.name})" in cells_of(path)[-1].source


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_holds_no_widget_which_would_be_an_error_to_whoever_opens_it(path: Path) -> None:
    kinds = {kind for cell in cells_of(path) for output in cell.get("outputs", []) for kind in output.get("data", {})}
    assert kinds & {"application/vnd.jupyter.widget-view+json", "application/vnd.jupyter.widget-state+json"} == set()


# The checks themselves


def test_a_figure_without_its_code_is_seen() -> None:
    shown = code('Image("../results/figures/gallery.png")')
    line = markdown("*How the figure below is drawn: [gallery.py](../experiments/figures/paper/gallery.py).*")
    assert unexplained([line, code("x = 1"), shown]) == []
    assert unexplained([line, markdown("More."), shown]) == ['Image("../results/figures/gallery.png")']


def markdown(source: str) -> Any:
    return nbformat.v4.new_markdown_cell(source)


def code(source: str, *tags: str) -> Any:
    return nbformat.v4.new_code_cell(source, metadata={"tags": list(tags)})


@pytest.mark.parametrize(
    ("source", "fault"),
    [
        ("# Morphs\n\n*Mukherjee and Gopi, Section 5, Figure 7.*", ""),
        ("# Numbers\n\n*Table 1.*", ""),
        ("## Morphs\n\n*Section 5*", "the first cell is no title"),
        ("# Section 5", "the first cell does not name the paper's section below its title"),
        ("# Morphs\n\nHow they move.", "the first cell does not name the paper's section below its title"),
    ],
)
def test_a_missing_title_is_seen(source: str, fault: str) -> None:
    assert title_fault([markdown(source)]) == fault


@pytest.mark.parametrize(
    ("cells", "count"),
    [
        ([markdown("Text"), code("x")], 0),
        ([markdown("Text"), code("x", "nbval-ignore-output")], 1),
        ([markdown("Text"), code("# NBVAL_IGNORE_OUTPUT\nx")], 1),
        ([markdown("Text"), code("x", "nbval-skip"), markdown("More text")], 1),
        ([markdown("The time differs from run to run and is not compared."), code("x", "nbval-ignore-output")], 0),
        ([code("# NBVAL_SKIP\nx"), markdown("That output is\nnot compared, as it is a time.")], 0),
        ([markdown("It is not compared."), code("y"), code("x", "raises-exception")], 1),
    ],
)
def test_an_unchecked_cell_without_a_reason_is_seen(cells: list[Any], count: int) -> None:
    assert len(reason_faults(cells)) == count


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ('pd.read_csv("../results/table_1_to_disk.csv")', 0),
        ('Image("../results/figures/gallery.png", width=720)', 0),
        ('[Image(f"../results/figures/table_1_{path}.png") for path in paths]', 0),
        ('Image("../results/figures/no_such_figure.png")', 1),
        ('pd.read_csv(f"../results/no_such_{study}.csv")', 1),
        ('open("../README.md").read()', 1),
        ('pd.read_csv("table.csv")', 1),
        ('folder = "../tests"', 1),
        ('print("x/y of ../results")', 0),
    ],
)
def test_a_path_to_nowhere_is_seen(source: str, count: int) -> None:
    assert len(path_faults(source)) == count


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ("See [the code](../experiments/studies/to_disk.py) and [Pivots](03_incompatible_morphs.ipynb#pivots).", 0),
        ("![Gallery](../results/figures/gallery.png)", 0),
        ("![Gallery](../results/figures/no_such_figure.png)", 1),
        ("[Elsewhere](https://example.org) and [below](#the-check)", 0),
    ],
)
def test_a_link_to_nowhere_is_seen(source: str, count: int) -> None:
    assert len(link_faults(source)) == count
