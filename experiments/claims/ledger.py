"""What a claim is, and the ledger that they are entered into.

A claim is a function in the file of its section: it reads results of the studies, or what `measure` has measured for
the ledger alone, and returns the number in a short phrase, the cases as the paper has it, and, where the claim has a
condition, the cases that meet it.  The verdict is not stated: `.rules` makes it of the cases, the same way for all.
The text is the paper's, quoted where there are quotation marks.
"""

from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import pandas as pd

from experiments import catalogue
from experiments.claims.rules import CONDITION, Cases, Rule, intervals, p_values, verdict
from experiments.store import RESULTS

COLUMNS = [
    *("id", "section", "kind", "claim", "rule", "as_printed", "verdict"),
    *("number", "interval", "p", "condition", "evidence", "figure"),
]

CLAIM, QUESTION = "claim", "open question"  # the paper says it, or asks for it and the answer is ours


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


class Finding(NamedTuple):
    """The number in a short phrase, the cases as printed, and those that meet the condition, if there is one."""

    number: str
    printed: tuple[Cases, ...]
    under: tuple[Cases, ...] = ()


class Claim(NamedTuple):
    """A row of the ledger, and the function that finds its number; of an open question, whether our answer holds."""

    section: str
    text: str
    rule: Rule
    cases: str  # what a case is, and what it has to do
    condition: str
    evidence: tuple[str, ...]  # files, or tests as path::name
    figure: str
    find: Callable[[Numbers], Finding]
    kind: str = CLAIM


LEDGER: dict[str, Claim] = {}


def claim(
    section: str,
    text: str,
    rule: Rule,
    cases: str,
    evidence: tuple[str, ...],
    *,
    figure: str = "",
    condition: str = "",
    kind: str = CLAIM,
) -> Callable[[Callable[[Numbers], Finding]], Callable[[Numbers], Finding]]:
    """Enter a claim into the ledger; its id is the name of the function."""

    def enter(find: Callable[[Numbers], Finding]) -> Callable[[Numbers], Finding]:
        name = find.__name__.replace("_", "-")
        LEDGER[name] = Claim(section, text, rule, cases, condition, evidence, figure, find, kind)
        return find

    return enter


def row(name: str, c: Claim, x: Numbers) -> list[str]:
    """A claim's row; the rule by which it is judged is the one that it was entered with."""
    found = c.find(x)
    if {part.rule for part in (*found.printed, *found.under)} != {c.rule} or bool(found.under) != bool(c.condition):
        raise ValueError(f"{name}: cases by the rule '{c.rule}' are wanted, and others only where there is a condition")
    judged = verdict(found.printed, found.under)
    condition = c.condition if judged == CONDITION else ""
    parts = (*found.printed, *(part._replace(label=f"[{part.label or 'condition'}]") for part in found.under))
    told = [found.number, intervals(parts), p_values(parts)]
    stated = [name, c.section, c.kind, c.text, f"{c.rule}: {c.cases}"]
    return [*stated, verdict(found.printed), judged, *told, condition, "; ".join(c.evidence), c.figure]


def ledger(x: Numbers) -> pd.DataFrame:
    """Every claim with its number, its interval and the verdict that they lead to, in the order of the sections."""
    rows = [row(name, c, x) for name, c in LEDGER.items()]
    return pd.DataFrame(rows, columns=COLUMNS).sort_values(
        "section", key=lambda s: s.str[0].astype(int), kind="stable", ignore_index=True
    )
