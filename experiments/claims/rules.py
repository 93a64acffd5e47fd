"""How cases become a verdict: four rules that are the same for all claims, and one function that applies them.

A claim says which rule it is read by and what a case is; what is measured is put into `Cases` by the function of that
rule, and `verdict` does the rest.  Intervals are 95 %: Wilson's where the cases are independent, else by resampling.
"""

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from scipy.stats import binomtest, bootstrap

from experiments.studies.matching import resampled_weights, share
from experiments.studies.quality import median_interval

Rule = Literal["every", "some", "more", "tracks"]
Verdict = Literal["holds", "holds under a condition", "holds weakly", "no difference seen", "fails"]
HOLDS: Verdict = "holds"
CONDITION: Verdict = "holds under a condition"
WEAK: Verdict = "holds weakly"
UNSEEN: Verdict = "no difference seen"
FAILS: Verdict = "fails"
VERDICTS = (HOLDS, CONDITION, WEAK, UNSEEN, FAILS)

RULES: dict[Rule, str] = {
    "every": "A statement about all cases.  It holds where no case contradicts it, and fails where one does.",
    "some": "A statement that something happens, or may.  It holds where it is seen at least once.",
    "more": "A comparison, case by case, ties left out.  It holds where the share of cases that come out the paper's "
    "way has a 95 % interval above one half and a sign test gives p < 0.05; it fails where both say the opposite.  Of "
    "pairs of curves the interval resamples curves, and the test counts curves, each by the majority of its pairs.",
    "tracks": "A rank correlation in each of many groups.  It holds where its 95 % interval lies above 0 and the "
    "median is 0.3 at least, and holds weakly where the interval lies above 0 and the median is below 0.3; it fails "
    "where the interval lies below 0.",
}
TOGETHER = (
    "Where none of this is the case, no difference was seen.  A claim of several parts is as good as its worst part.  "
    "One that does not hold as printed holds under a condition where the cases that meet the condition hold by the "
    "same rule."
)
ORIGIN = (
    "The rules were not registered anywhere: they were fixed before the verdicts, but earlier versions of many numbers "
    "were known.  The conditions were found after the numbers, from the part of the cases that came out the paper's "
    "way, and are hypotheses for other curves.  That a claim holds weakly was told apart from no difference after the "
    "numbers, too."
)
CLEAR, MODERATE = 0.05, 0.3


class Cases(NamedTuple):
    """What the cases say: a share of them, or a median correlation, with its interval and, if tested, its p."""

    rule: Rule
    of: int  # cases that count, or groups
    value: float
    low: float
    high: float
    p: float | None = None
    label: str = ""


def every(agree: int, of: int, label: str = "") -> Cases:
    """All cases, and how many agree."""
    return _counted("every", agree, of, label)


def some(seen: int, of: int, label: str = "") -> Cases:
    """All cases, and in how many it is seen."""
    return _counted("some", seen, of, label)


def _counted(rule: Rule, agree: int, of: int, label: str) -> Cases:
    ci = binomtest(int(agree), int(of)).proportion_ci(method="wilson")
    return Cases(rule, int(of), agree / of, ci.low, ci.high, None, label)


def more(better: int, worse: int, label: str = "") -> Cases:
    """How many independent cases come out the paper's way, and how many the other way."""
    if better + worse == 0:
        return Cases("more", 0, 0.5, 0.0, 1.0, 1.0, label)
    return _counted("more", better, better + worse, label)._replace(p=_sign_test(int(better), int(worse)))


def more_pairs(difference: pd.Series, label: str = "") -> Cases:
    """A difference for each pair of curves, positive the paper's way.

    Pairs that share a curve are not independent.  So the interval of the share resamples curves, and the sign test
    counts curves, each by the majority of its pairs.
    """
    told = difference[difference != 0] > 0
    if told.empty:
        return more(0, 0, label)
    ends = told.index.to_frame(index=False).set_axis(["source", "target"], axis=1)
    found = share(told, resampled_weights(ends))
    signs = np.where(told, 1, -1)
    by_end = [pd.Series(signs).groupby(ends[end].to_numpy()).sum() for end in ends]
    majority = by_end[0].add(by_end[1], fill_value=0)
    p = _sign_test(int((majority > 0).sum()), int((majority < 0).sum()))
    return Cases("more", len(told), found["share"], found["low"], found["high"], p, label)


def _sign_test(better: int, worse: int) -> float:
    return float(binomtest(better, better + worse).pvalue) if better + worse else 1.0


def tracks(correlations: ArrayLike, label: str = "") -> Cases:
    """A rank correlation for each group; the interval of their median resamples the groups."""
    rho: NDArray[np.float64] = np.asarray(correlations, dtype=np.float64)
    rho = rho[~np.isnan(rho)]
    ci = bootstrap((rho,), np.median, n_resamples=2000, method="percentile", rng=np.random.default_rng(20100))
    low, high = ci.confidence_interval
    return Cases("tracks", len(rho), float(np.median(rho)), float(low), float(high), None, label)


def tracks_pairs(correlations: pd.Series, label: str = "") -> Cases:
    """A rank correlation for each pair of curves; the interval of their median resamples curves, not pairs."""
    order = correlations.sort_values()
    draws = resampled_weights(order.index.to_frame(index=False).set_axis(["source", "target"], axis=1))
    ci = median_interval(order, draws)
    return Cases("tracks", len(order), float(order.median()), ci["low"], ci["high"], None, label)


def outcome(cases: Cases) -> Verdict:
    """What one part of a claim comes to."""
    if cases.rule == "every":
        return HOLDS if cases.value == 1 else FAILS
    if cases.rule == "some":
        return HOLDS if cases.value > 0 else UNSEEN
    if cases.rule == "more":
        clear = cases.p is not None and cases.p < CLEAR
        return HOLDS if clear and cases.low > 0.5 else FAILS if clear and cases.high < 0.5 else UNSEEN
    if cases.low > 0:
        return HOLDS if cases.value >= MODERATE else WEAK
    return FAILS if cases.high < 0 else UNSEEN


def _together(parts: Sequence[Cases]) -> Verdict:
    return max((outcome(part) for part in parts), key=VERDICTS.index)  # they are in order, the worst last


def verdict(printed: Sequence[Cases], under: Sequence[Cases] = ()) -> Verdict:
    """The verdict on a claim, from the cases as printed and from those that meet its condition, if it has one."""
    as_printed = _together(printed)
    return CONDITION if as_printed != HOLDS and under and _together(under) == HOLDS else as_printed


# How it is written


def intervals(cases: Sequence[Cases]) -> str:
    """Each part: how many cases agree, with the interval of their share; or the median correlation, with its own."""
    return "; ".join(_labelled(c, f"{_found(c)} ({c.low:.3g} to {c.high:.3g})") for c in cases)


def _found(cases: Cases) -> str:
    if cases.rule == "tracks":
        return f"rho = {cases.value:.3g} in {cases.of} groups"
    return f"{round(cases.value * cases.of):,} of {cases.of:,}"


def p_values(cases: Sequence[Cases]) -> str:
    """Each part's p, where there is one."""
    return "; ".join(_labelled(c, f"{c.p:.2g}") for c in cases if c.p is not None)


def _labelled(cases: Cases, text: str) -> str:
    return f"{cases.label}: {text}" if cases.label else text
