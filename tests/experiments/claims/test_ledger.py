"""The ledger of claims: complete, well-formed, and each row's evidence is there to be looked at."""

import re
from pathlib import Path

import pandas as pd
import pytest

import experiments.claims.measure  # noqa: F401, it enters the claims of all sections
from experiments import store
from experiments.claims import ledger as claims

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
    assert list(TABLE["id"]) == list(claims.LEDGER)
    assert TABLE["id"].is_unique and len(TABLE) >= 20
    assert set(TABLE["id"]) >= WANTED
    for row in TABLE.itertuples():
        c = claims.LEDGER[row.id]
        written = (row.section, row.claim, row.verdict, row.condition, row.evidence, row.figure)
        assert written == (c.section, c.text, c.verdict, c.condition, "; ".join(c.evidence), c.figure)


def test_every_row_says_what_it_must() -> None:
    assert set(TABLE["verdict"]) == {claims.HOLDS, claims.CONDITION, claims.FAILS}
    assert ((TABLE["condition"] != "") == (TABLE["verdict"] == claims.CONDITION)).all()
    assert TABLE["number"].str.contains(r"\d").all()
    assert TABLE["claim"].str.len().min() > 0
    assert TABLE["section"].str.match(r"[1-8]").all()
    assert TABLE["section"].str[0].astype(int).is_monotonic_increasing


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
    supported, number = claims.LEDGER[name].find(claims.Numbers(dict))
    assert supported
    assert number == TABLE.set_index("id").loc[name, "number"]


# How it is made


def test_a_missing_result_is_answered_with_the_study_to_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claims, "RESULTS", tmp_path)
    with pytest.raises(SystemExit, match=r"pairs.csv is missing; run python -m experiments.studies.pairs first"):
        claims.Numbers(dict).table("pairs")


def test_a_verdict_that_is_not_borne_out_stops_the_ledger(monkeypatch: pytest.MonkeyPatch) -> None:
    c = claims.LEDGER["symmetric"]._replace(find=lambda x: (False, "0 of 1"))
    monkeypatch.setattr(claims, "LEDGER", {"symmetric": c})
    with pytest.raises(SystemExit, match="'holds under a condition' is not borne out for symmetric: 0 of 1"):
        claims.ledger(claims.Numbers(dict))


@pytest.mark.parametrize(("better", "cases", "is_most"), [(2, 3, True), (23, 34, True), (22, 34, False), (0, 1, False)])
def test_most_is_two_thirds(better: int, cases: int, is_most: bool) -> None:
    assert claims.most(better, cases) == is_most
