"""Table 1 in the paper's layout: three files, one content."""

import re

import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import table_1_layout as layout

COLUMNS = pd.read_csv(RESULTS / "table_1_curve_to_curve.csv")
WIDTH = 2 + 8  # measure, whose, X and Y of four columns


def cells_of_latex(row: str) -> int:
    """Columns that a row takes up, a multicolumn cell as many as it says."""
    return sum(int(m[1]) if (m := re.match(r"\s*\\multicolumn\{(\d)\}", c)) else 1 for c in row.split("&"))


def test_the_committed_tables_are_what_the_code_gives() -> None:
    assert (RESULTS / "table_1.csv").read_text() == layout.as_csv(COLUMNS).to_csv(index=False, lineterminator="\n")
    assert (RESULTS / "table_1.md").read_text() == layout.as_markdown(COLUMNS)
    assert (RESULTS / "table_1.tex").read_text() == layout.as_latex(COLUMNS)


def test_every_row_of_the_latex_table_fills_all_columns() -> None:
    text = layout.as_latex(COLUMNS)
    rows = [line.removesuffix(r" \\") for line in text.splitlines() if line.endswith(r"\\")]
    assert len(rows) == 2 + len(list(layout.lines(COLUMNS)))
    assert {cells_of_latex(row) for row in rows} == {WIDTH}
    assert rf"\begin{{tabular}}{{ll{'r' * 8}}}" in text


def test_the_latex_table_is_well_formed() -> None:
    text = layout.as_latex(COLUMNS)
    assert text.count("{") == text.count("}")
    opened, closed = (re.findall(rf"\\{word}{{(\w+)}}", text) for word in ("begin", "end"))
    assert opened == closed[::-1] == ["table", "tabular"]
    body = "\n".join(line for line in text.splitlines() if not line.startswith("%"))
    assert not re.search(r"(?<!\\)[_%#$]", body)


def test_special_characters_are_escaped() -> None:
    assert layout.escaped("a_b & 5% #1 $") == r"a\_b \& 5\% \#1 \$"


def test_the_markdown_table_has_the_cells_of_the_csv() -> None:
    rows = [line.strip("| ").split(" | ") for line in layout.as_markdown(COLUMNS).splitlines() if line.startswith("|")]
    table = layout.as_csv(COLUMNS)
    assert len(rows) == 2 + len(table)
    for row, record in zip(rows[2:], table.to_numpy().tolist(), strict=True):
        assert [cell.strip() for cell in row] == record


@pytest.mark.parametrize(("row", "x", "y"), [(1, 7, 31), (3, 17, 42), (4, 10, 13), (7, 23, 36)])
def test_the_papers_ranks_stand_in_its_columns(row: int, x: int, y: int) -> None:
    table = layout.as_csv(COLUMNS).set_index(["measure", "whose"])
    assert table.loc[("AR", "paper"), [f"Figure 11, row {row} X", f"Figure 11, row {row} Y"]].tolist() == [
        str(x),
        str(y),
    ]
    assert table.loc[("AR, Y/X", "paper"), f"Figure 11, row {row} Y"] == f"{y / x:.2f}"


def test_ratios_are_those_of_the_columns() -> None:
    table = layout.as_csv(COLUMNS).set_index(["measure", "whose"])
    for path in ("linear", "slide"):
        values = COLUMNS[(COLUMNS.row == 1) & (COLUMNS.path == path)].set_index("triangulation")["AR_1e-4"]
        expected = f"{values['own_median'] / values['remeshed']:.2f}"
        assert table.loc[("AR at 1e-4, Y/X", f"{path}, Y flipped"), "Figure 11, row 1 Y"] == expected


def test_a_table_without_common_triangulations_says_none() -> None:
    table = layout.as_csv(COLUMNS).set_index(["measure", "whose"])
    assert table.loc[("AR at 1e-4", "slide, Y common"), "Figure 11, row 4 Y"] == "none"
