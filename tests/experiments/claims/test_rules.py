"""Rules of the ledger: each of the four decides as it says, and a condition is judged by the same rule."""

import numpy as np
import pandas as pd
import pytest

from experiments import subjects
from experiments.claims import rules
from experiments.claims.rules import (
    CONDITION,
    FAILS,
    HOLDS,
    UNSEEN,
    WEAK,
    every,
    more,
    more_pairs,
    outcome,
    some,
    tracks,
)


def test_one_case_against_it_makes_a_statement_about_all_fail() -> None:
    assert outcome(every(34, 34)) == HOLDS
    assert outcome(every(33, 34)) == FAILS


def test_what_may_happen_holds_once_it_is_seen_and_does_not_fail_where_it_is_not() -> None:
    assert outcome(some(1, 34)) == HOLDS
    assert outcome(some(0, 34)) == UNSEEN


@pytest.mark.parametrize(
    ("better", "worse", "expected"),
    [
        (34, 0, HOLDS),
        (24, 10, HOLDS),
        (23, 11, UNSEEN),
        (12, 22, UNSEEN),
        (10, 24, FAILS),
        (0, 34, FAILS),
        (0, 0, UNSEEN),
    ],
)
def test_a_comparison_is_decided_by_the_interval_and_the_sign_test(better: int, worse: int, expected: str) -> None:
    assert outcome(more(better, worse)) == expected


def test_the_interval_is_wilsons_and_p_that_of_the_sign_test() -> None:
    cases = more(12, 22)
    assert (cases.value, cases.low, cases.high) == pytest.approx((12 / 34, 0.2149, 0.5209), abs=1e-4)
    assert cases.p == pytest.approx(0.1214, abs=1e-4)


def test_pairs_of_few_curves_say_less_than_as_many_independent_cases() -> None:
    index = pd.MultiIndex.from_tuples([tuple(p.split(subjects.BETWEEN)) for p in subjects.pairs(list("abcdefgh"))])
    signs = pd.Series(np.where([a in "abc" for a, _ in index], 1.0, -1.0), index=index)
    pairs, cases = more_pairs(signs), more(int((signs > 0).sum()), int((signs < 0).sum()))
    assert pairs.value == cases.value
    assert pairs.low < cases.low and pairs.high > cases.high
    assert pairs.p is not None and cases.p is not None and pairs.p > cases.p
    assert more_pairs(abs(signs)).p == pytest.approx(2 * 0.5**8)  # all eight curves, by the majority of their pairs
    assert outcome(more_pairs(0 * signs)) == UNSEEN


def test_a_correlation_holds_where_it_is_moderate_and_weakly_where_it_is_only_above_nothing() -> None:
    rng = np.random.default_rng(1)
    assert outcome(tracks(0.5 + 0.1 * rng.standard_normal(30))) == HOLDS
    assert outcome(tracks(0.2 + 0.05 * rng.standard_normal(30))) == WEAK
    assert outcome(tracks(0.3 * rng.standard_normal(30))) == UNSEEN
    assert outcome(tracks(-0.5 + 0.1 * rng.standard_normal(30))) == FAILS
    assert tracks([0.5, np.nan, 0.5]).value == 0.5


def test_a_claim_needs_all_its_parts_and_its_condition_is_judged_alike() -> None:
    yes, no, open_ = every(3, 3), every(2, 3), some(0, 3)
    assert rules.verdict((yes, yes)) == HOLDS
    assert rules.verdict((yes, open_)) == UNSEEN
    assert rules.verdict((yes, open_, no)) == FAILS
    weak = rules.Cases("tracks", 30, 0.2, 0.1, 0.3)
    assert rules.verdict((yes, weak)) == WEAK
    assert rules.verdict((weak, open_)) == UNSEEN
    assert rules.verdict((weak,), (yes,)) == CONDITION
    assert rules.verdict((no,), (yes,)) == CONDITION
    assert rules.verdict((open_,), (yes,)) == CONDITION
    assert rules.verdict((no,), (no,)) == FAILS
    assert rules.verdict((yes,), (no,)) == HOLDS


def test_parts_are_written_with_their_names() -> None:
    assert rules.intervals((every(1, 1, "a"), more(1, 1))) == "a: 1 of 1 (0.207 to 1); 1 of 2 (0.0945 to 0.905)"
    assert rules.intervals([rules.Cases("tracks", 561, 0.25, 0.2, 0.3)]) == "rho = 0.25 in 561 groups (0.2 to 0.3)"
    assert rules.intervals([more(0, 0)]) == "0 of 0 (0 to 1)"
    assert rules.p_values((every(1, 1, "a"), more(1, 1, "b"))) == "b: 1"
