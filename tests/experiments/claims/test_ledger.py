"""The ledger of claims: complete, well-formed, and each row's evidence is there to be looked at."""

import re
from pathlib import Path

import pandas as pd
import pytest

import experiments.claims.measure  # noqa: F401, it enters the claims of all sections
from experiments import store
from experiments.claims import ledger as claims
from experiments.claims import rules

TABLE = pd.read_csv(store.RESULTS / "claims.csv", keep_default_na=False)
WANTED = {
    "every-frame-bounds-a-disk",
    "swaps-stay-valid",
    "remeshing-ends",
    "compatible-iff-degrees",
    "best-is-prohibitive",
    "smaller-rank-to-the-disk",
    "smaller-variance-to-the-disk",
    "smaller-rank-between-curves",
    "smaller-variance-between-curves",
    "twists-without-the-interior",
    "at-most-one-non-monotone",
    "slide-keeps-lengths-between",
    "slide-spares-the-other-edge",
    "linear-preserves-areas",
    "slide-isolates",
    "central-root-spreads",
    "pivots-help",
    "flips-arrive",
    "flips-happen-near-the-circle",
    "u-and-v-exist",
    "symmetric",
    "reaches-the-target",
    "flips-terminate",
    "decomposition-is-cubic",
    "leaves-are-features",
    "pivots-are-critical",
    "root-matters",
    "compatibility-is-quadratic",
    "better-alignment",
    "flips-can-be-early",
    "central-root-is-good",
    "root-keeps-sizes",
    "slide-shrinks-less",
}


def needs_measuring(name: str) -> bool:
    """Say whether a claim reads measurements beside the results of other studies."""
    try:
        claims.LEDGER[name].find(claims.Numbers(dict))
    except KeyError:
        return True
    return False


# The table


def test_the_table_is_the_ledger_and_has_every_claim_that_was_asked_for() -> None:
    assert list(TABLE.columns) == claims.COLUMNS
    assert set(TABLE["id"]) == set(claims.LEDGER)
    assert TABLE["id"].is_unique and len(TABLE) >= 20
    assert set(TABLE["id"]) >= WANTED
    for row in TABLE.itertuples():
        c = claims.LEDGER[row.id]
        written = (row.section, row.kind, row.claim, row.rule, row.evidence, row.figure)
        assert written == (c.section, c.kind, c.text, f"{c.rule}: {c.cases}", "; ".join(c.evidence), c.figure)
        assert row.condition == (c.condition if row.verdict == rules.CONDITION else "")


def test_every_row_says_what_it_must() -> None:
    assert set(TABLE["verdict"]) <= set(rules.VERDICTS)
    assert set(TABLE["as_printed"]) <= set(rules.VERDICTS) - {rules.CONDITION}
    assert (TABLE["as_printed"] == TABLE["verdict"])[TABLE["verdict"] != rules.CONDITION].all()
    assert (TABLE["as_printed"] != rules.HOLDS)[TABLE["verdict"] == rules.CONDITION].all()
    assert ((TABLE["condition"] != "") == (TABLE["verdict"] == rules.CONDITION)).all()
    assert set(TABLE["rule"].str.partition(":")[0]) == set(rules.RULES)
    assert ((TABLE["p"] != "") == TABLE["rule"].str.startswith("more:")).all()
    assert (
        TABLE["interval"]
        .str.fullmatch(r"(.*: )?([\d,]+ of [\d,]+|rho = [-\d.e]+ in \d+ groups) \([-\d.e]+ to [-\d.e]+\)")
        .all()
    )
    assert TABLE["number"].str.contains(r"\d").all()
    assert TABLE["claim"].str.len().min() > 0
    assert TABLE["section"].str.match(r"[1-8]").all()
    assert TABLE["section"].str[0].astype(int).is_monotonic_increasing


def test_the_three_open_questions_are_told_from_the_claims() -> None:
    questions = TABLE[TABLE["kind"] == claims.QUESTION]
    assert set(questions["id"]) == {"better-alignment", "flips-can-be-early", "central-root-is-good"}
    assert questions["rule"].str.contains(": our answer: ").all()
    assert set(TABLE["kind"]) == {claims.CLAIM, claims.QUESTION}


def test_a_measure_is_asked_for_quality_also_where_all_frames_bound_disks() -> None:
    for name in ("rank-tracks-smoothness", "variance-tracks-smoothness"):
        row = TABLE[TABLE["id"] == name].iloc[0]
        parts = row["interval"].split("; ")
        under = [part for part in parts if part.startswith("[")]
        assert (len(parts), len(under)) == (5, 2) and not any("frames" in part for part in under)
        assert row["as_printed"] != rules.HOLDS and row["verdict"] == rules.CONDITION


@pytest.mark.parametrize("evidence", sorted({e for row in TABLE["evidence"] for e in row.split("; ")}))
def test_the_evidence_exists(evidence: str) -> None:
    path, _, test = evidence.partition("::")
    assert path.startswith("tests/" if test else "experiments/")
    source = (store.ROOT / path).read_text(encoding="utf-8")
    assert not test or re.search(rf"^def {test}\(", source, re.MULTILINE)


@pytest.mark.parametrize("figure", sorted(set(TABLE["figure"]) - {""}))
def test_the_figure_exists(figure: str) -> None:
    folder = store.ROOT / "notebooks" if figure.endswith(".ipynb") else store.FIGURES
    assert (folder / figure).is_file()


@pytest.mark.parametrize("name", [name for name in claims.LEDGER if not needs_measuring(name)])
def test_numbers_from_other_studies_are_those_of_their_results(name: str) -> None:
    found = claims.row(name, claims.LEDGER[name], claims.Numbers(dict))
    assert found == TABLE[TABLE.id == name].iloc[0].tolist()


# How it is made


def test_a_missing_result_is_answered_with_the_study_to_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claims, "RESULTS", tmp_path)
    with pytest.raises(SystemExit, match=r"pairs.csv is missing; run python -m experiments.studies.pairs first"):
        claims.Numbers(dict).table("pairs")


def entered(rule: rules.Rule, condition: str, *parts: tuple[rules.Cases, ...]) -> list[str]:
    """Return the row of a claim with such cases."""
    c = claims.LEDGER["symmetric"]
    c = c._replace(rule=rule, condition=condition, find=lambda x: claims.Finding("a number", *parts))
    return claims.row("symmetric", c, claims.Numbers(dict))


def test_the_verdict_is_made_of_the_cases_and_the_condition_is_told_where_it_matters() -> None:
    none, whole = (rules.every(0, 3),), (rules.every(3, 3),)
    verdict, condition = claims.COLUMNS.index("verdict"), claims.COLUMNS.index("condition")
    for parts, expected in (
        ((none, whole), rules.CONDITION),
        ((whole, whole), rules.HOLDS),
        ((none, none), rules.FAILS),
    ):
        row = entered("every", "if so", *parts)
        assert row[verdict] == expected
        assert row[condition] == ("if so" if expected == rules.CONDITION else "")


def test_a_claim_is_judged_by_the_rule_that_it_was_entered_with() -> None:
    with pytest.raises(ValueError, match="cases by the rule 'more' are wanted"):
        entered("more", "", (rules.every(3, 3),))
    with pytest.raises(ValueError, match="only where there is a condition"):
        entered("every", "", (rules.every(3, 3),), (rules.every(3, 3),))
