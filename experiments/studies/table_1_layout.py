"""Table 1 in the paper's layout, the paper's numbers above ours, as CSV, Markdown and LaTeX.

The columns are rows 1, 3, 4 and 7 of Figure 11, each with X, remeshed, and Y, arbitrary.  Reads
results/table_1_curve_to_curve.csv, which `curve_to_curve` writes; writes results/table_1.csv, .md and .tex.
"""

import argparse
from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import pandas as pd

from experiments.measures import PARAMETERS
from experiments.store import RESULTS, write_csv, write_text
from experiments.studies.curve_to_curve import DRAWS

HEADLINE, TOLERANCES = "1e-4", ("1e-4", "1e-6", "1e-9")
CAPTION = (
    "Quality of the morph between two curves: remeshed (X) and arbitrary (Y) triangulations, the paper's and ours, "
    "along both of the paper's paths."
)
NOTE = (
    f"Y flipped: the median, and below it the range, of {DRAWS} uniformly drawn triangulations of "
    "each curve, flipped into each other on the way. Y common: the median of as many drawn uniformly from those that "
    "are valid in both curves, where there are any; they need no flips. Every morph is on one clock, vertices at "
    f"constant root mean square speed; {PARAMETERS['frames']} frames, areas as shares of the source's. The paper's "
    "curves, number of frames, rank tolerance, path, clock and unit of area are unpublished, and it shows one "
    "arbitrary triangulation a curve: our curves are stand-ins, and only the ratios Y/X can be compared."
)
LATEX = {"_": r"\_", "%": r"\%", "&": r"\&", "#": r"\#", "$": r"\$"}


class Line(NamedTuple):
    """A row of the table: what it shows, whose number it is, and for each column X and Y, or one cell for both."""

    measure: str
    whose: str
    cells: Sequence[tuple[str, str] | str]


def lines(columns: pd.DataFrame) -> Iterator[Line]:
    """The rows of the table: measures first, then the ratios Y/X."""
    of = {
        path: [b.set_index("triangulation") for _, b in some.groupby("row")] for path, some in columns.groupby("path")
    }
    blocks = of["linear"]
    yield Line("curves", "ours", [block.pair.iloc[0] for block in blocks])
    yield Line("flips", "ours, Y flipped", [x_and_y(block, "flips", "own") for block in blocks])
    for measure, key in (("AR", f"AR_{HEADLINE}"), ("Var", "Var")):
        yield Line(measure, "paper", [paper(block, measure) for block in blocks])
        for path, some in of.items():
            yield Line(label(key), f"{path}, Y flipped", [x_and_y(block, key, "own") for block in some])
            yield Line(label(key), f"{path}, range of Y", [spread(block, key, "own") for block in some])
            yield Line(label(key), f"{path}, Y common", [x_and_y(block, key, "common") for block in some])
    for measure, keys in (("AR", [f"AR_{t}" for t in TOLERANCES]), ("Var", ["Var"])):
        yield Line(f"{measure}, Y/X", "paper", [ratio(*map(float, paper(block, measure))) for block in blocks])
        for (path, some), key in product(of.items(), keys):
            yield Line(f"{label(key)}, Y/X", f"{path}, Y flipped", [over_remeshed(b[key], "own") for b in some])
            yield Line(f"{label(key)}, Y/X", f"{path}, Y common", [over_remeshed(b[key], "common") for b in some])


def label(key: str) -> str:
    return key.replace("_", " at ")


def paper(block: pd.DataFrame, measure: str) -> tuple[str, str]:
    """X and Y as printed."""
    x, y = (block.loc["remeshed", f"paper_{measure}_{which}"] for which in ("remeshed", "arbitrary"))
    return f"{x:g}", f"{y:g}"


def x_and_y(block: pd.DataFrame, key: str, kind: str) -> tuple[str, str]:
    return cell(block, key, "remeshed"), cell(block, key, f"{kind}_median")


def spread(block: pd.DataFrame, key: str, kind: str) -> str:
    return f"{cell(block, key, f'{kind}_min')} to {cell(block, key, f'{kind}_max')}"


def cell(block: pd.DataFrame, key: str, which: str) -> str:
    if which not in block.index:
        return "none"
    value = block.loc[which, key]
    return f"{value:.1e}" if key == "Var" else f"{value:.0f}"


def over_remeshed(values: "pd.Series[float]", kind: str) -> str:
    return ratio(values["remeshed"], values[f"{kind}_median"]) if f"{kind}_median" in values else "none"


def ratio(x: float, y: float) -> str:
    return f"{y / x:.2f}" if y < 1000 * x else f"{y / x:.1e}"


def header(columns: pd.DataFrame) -> list[str]:
    return [f"Figure 11, row {row}" for row in columns.row.unique()]


def as_pairs(line: Line) -> list[str]:
    """The cells, one for both X and Y standing under Y."""
    return [part for c in line.cells for part in (("", c) if isinstance(c, str) else c)]


def as_csv(columns: pd.DataFrame) -> pd.DataFrame:
    names = [f"{name} {part}" for name in header(columns) for part in "XY"]
    return pd.DataFrame(
        [[line.measure, line.whose, *as_pairs(line)] for line in lines(columns)], columns=["measure", "whose", *names]
    )


def as_markdown(columns: pd.DataFrame) -> str:
    names = [f"{name}: X | Y" for name in header(columns)]
    rows = [["", "", *names], ["---", "---", *["---:"] * 2 * len(names)]]
    rows += [[line.measure, line.whose, *as_pairs(line)] for line in lines(columns)]
    return "\n".join(["| " + " | ".join(row) + " |" for row in rows]) + f"\n\n{CAPTION} {NOTE}\n"


def as_latex(columns: pd.DataFrame) -> str:
    """A table for the package booktabs."""
    names = header(columns)
    rules = [rf"\cmidrule(lr){{{3 + 2 * i}-{4 + 2 * i}}}" for i in range(len(names))]
    body = []
    for line in lines(columns):
        if line.whose == "paper":
            body.append(r"\midrule")
        cells = [both(c) if isinstance(c, str) else " & ".join(map(escaped, c)) for c in line.cells]
        body.append(" & ".join([escaped(line.measure), escaped(line.whose), *cells]) + r" \\")
    return "\n".join(
        [
            r"% needs \usepackage{booktabs}",
            r"\begin{table}",
            r"\centering\footnotesize\setlength{\tabcolsep}{3pt}",
            rf"\caption{{{escaped(CAPTION)}}}",
            rf"\begin{{tabular}}{{ll{'rr' * len(names)}}}",
            r"\toprule",
            " & & " + " & ".join(map(both, names)) + r" \\",
            "".join(rules),
            " & & " + " & ".join(["X & Y"] * len(names)) + r" \\",
            r"\midrule",
            *body,
            r"\bottomrule",
            r"\end{tabular}",
            rf"\par\medskip\parbox{{\linewidth}}{{\footnotesize {escaped(NOTE)}}}",
            r"\end{table}",
            "",
        ]
    )


def both(text: str) -> str:
    return rf"\multicolumn{{2}}{{c}}{{{escaped(text)}}}"


def escaped(text: str) -> str:
    return "".join(LATEX.get(character, character) for character in text)


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.studies.table_1_layout", description=__doc__.split("\n")[0]
    ).parse_args()
    columns = pd.read_csv(RESULTS / "table_1_curve_to_curve.csv")
    write_csv(RESULTS / "table_1.csv", as_csv(columns))
    write_text(RESULTS / "table_1.md", as_markdown(columns))
    write_text(RESULTS / "table_1.tex", as_latex(columns))
    print("table_1_layout: the paper's layout -> results/table_1.csv, results/table_1.md, results/table_1.tex")


if __name__ == "__main__":
    main()
