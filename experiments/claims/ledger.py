"""What a claim is, and the ledger that they are entered into.

A claim is a function in the file of its section: it reads results of the studies, or what `measure` has measured for
the ledger alone, and returns whether they still bear its verdict out, and the number in a short phrase.  The text is
the paper's, quoted where there are quotation marks.

A comparison of many cases "holds" where it comes out the paper's way in two thirds of them at least.
"""

from collections.abc import Callable
from functools import cached_property
from typing import Literal, NamedTuple

import pandas as pd

from experiments import catalogue
from experiments.store import RESULTS

Verdict = Literal["holds", "holds under a condition", "fails"]
HOLDS: Verdict = "holds"
CONDITION: Verdict = "holds under a condition"
FAILS: Verdict = "fails"
COLUMNS = ["id", "section", "claim", "verdict", "number", "condition", "evidence", "figure"]
Finding = tuple[bool, str]


class Numbers:
    """Results of the studies, and what `measure` gives: a table for each kind of measurement, made when asked for."""

    def __init__(self, measure: Callable[[], dict[str, pd.DataFrame]]) -> None:
        self._measure = measure

    def table(self, name: str) -> pd.DataFrame:
        file = f"{name}.csv"
        if not (RESULTS / file).exists():
            raise SystemExit(f"claims: results/{file} is missing; run {catalogue.writer(file).command} first")
        return pd.read_csv(RESULTS / file)

    @cached_property
    def checks(self) -> dict[str, pd.DataFrame]:
        return self._measure()

    @property
    def curves(self) -> pd.DataFrame:
        return self.checks["curve"]


class Claim(NamedTuple):
    """A row of the ledger, and the function that finds its number."""

    section: str
    text: str
    verdict: Verdict
    condition: str
    evidence: tuple[str, ...]  # files, or tests as path::name
    figure: str
    find: Callable[[Numbers], Finding]


LEDGER: dict[str, Claim] = {}


def claim(
    section: str, text: str, verdict: Verdict, evidence: tuple[str, ...], figure: str = "", condition: str = ""
) -> Callable[[Callable[[Numbers], Finding]], Callable[[Numbers], Finding]]:
    """Enter a claim into the ledger; its id is the name of the function."""

    def enter(find: Callable[[Numbers], Finding]) -> Callable[[Numbers], Finding]:
        LEDGER[find.__name__.replace("_", "-")] = Claim(section, text, verdict, condition, evidence, figure, find)
        return find

    return enter


def most(better: int, cases: int) -> bool:
    """Two thirds at least."""
    return 3 * better >= 2 * cases


def ledger(x: Numbers) -> pd.DataFrame:
    """Every claim with its number; stops at verdicts that the numbers do not bear out."""
    rows, broken = [], []
    for name, c in LEDGER.items():
        supported, number = c.find(x)
        broken += [] if supported else [f"claims: '{c.verdict}' is not borne out for {name}: {number}"]
        rows.append([name, c.section, c.text, c.verdict, number, c.condition, "; ".join(c.evidence), c.figure])
    if broken:
        raise SystemExit("\n".join(broken))
    return pd.DataFrame(rows, columns=COLUMNS)
