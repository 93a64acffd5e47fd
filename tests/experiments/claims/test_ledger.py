"""The ledger of claims: complete, well-formed, and each row's evidence is there to be looked at."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from experiments import claim_checks, claims, store
from experiments.flips import flip_graph, polygon
from tween import decompose
from tween.morphing.incompatible.flip_sequence import count_crossings

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
SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64)


def needs_measuring(name: str) -> bool:
    """Say whether a claim reads measurements beside the results of other studies."""
    try:
        claims.LEDGER[name].find(claims.Numbers({}))
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
        assert written == (c.section, c.text, c.verdict, c.condition, c.evidence, c.figure)


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
    assert path.startswith("tests/test_" if test else "experiments/")
    source = (store.ROOT / path).read_text(encoding="utf-8")
    assert not test or re.search(rf"^def {test}\(", source, re.MULTILINE)


@pytest.mark.parametrize("figure", sorted(set(TABLE["figure"]) - {""}))
def test_the_figure_exists(figure: str) -> None:
    folder = store.ROOT / "notebooks" if figure.endswith(".ipynb") else store.FIGURES
    assert (folder / figure).is_file()


@pytest.mark.parametrize("name", [name for name in claims.LEDGER if not needs_measuring(name)])
def test_numbers_from_other_studies_are_those_of_their_results(name: str) -> None:
    supported, number = claims.LEDGER[name].find(claims.Numbers({}))
    assert supported
    assert number == TABLE.set_index("id").loc[name, "number"]


# How it is made


def test_a_missing_result_is_answered_with_the_study_to_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claims, "RESULTS", tmp_path)
    with pytest.raises(SystemExit, match=r"results/table1_columns.csv is missing; run python -m experiments.figure11"):
        claims.Numbers({}).table("table1_columns")


def test_a_verdict_that_is_not_borne_out_stops_the_ledger(monkeypatch: pytest.MonkeyPatch) -> None:
    c = claims.LEDGER["symmetric"]._replace(find=lambda x: (False, "0 of 1"))
    monkeypatch.setattr(claims, "LEDGER", {"symmetric": c})
    with pytest.raises(SystemExit, match="'holds' is not borne out for symmetric: 0 of 1"):
        claims.ledger(claims.Numbers({}))


@pytest.mark.parametrize(("better", "cases", "is_most"), [(2, 3, True), (23, 34, True), (22, 34, False), (0, 1, False)])
def test_most_is_two_thirds(better: int, cases: int, is_most: bool) -> None:
    assert claims.most(better, cases) == is_most


# The measurements


@pytest.mark.parametrize("n", range(4, 10))
def test_degrees_tell_triangulations_apart(n: int) -> None:
    found, _ = flip_graph(n)
    assert len({tuple(T.degrees.tolist()) for T in found}) == len(found)
    if n < 8:
        counted = claim_checks.degree_sequences(str(n))
        assert counted["disagree"] == 0
        assert (counted["mirrored"] > 0) == (n > 5)


@pytest.mark.parametrize("n", [6, 15, 30])
def test_flips_in_order_lead_to_the_target_within_the_crossings(n: int) -> None:
    S, T = decompose(polygon(n)).sample(np.random.default_rng(n), 2)
    found, flips, idle = claim_checks.inserted_in_order(S, T)
    np.testing.assert_array_equal(found.validate().canonical, T.canonical)
    assert 0 <= idle <= flips <= count_crossings(S, T)
    claim_checks.inserted_once(S, T).validate()


def test_only_polygons_that_show_the_front_of_a_disk_bound_one() -> None:
    fan, elsewhere = np.array([(0, 1, 2), (0, 2, 3)]), np.array([(0, 1, 2), (0, 1, 3)])
    assert claim_checks.bounds_disk(SQUARE, fan) and claim_checks.bounds_disk(SQUARE, elsewhere)
    assert not claim_checks.bounds_disk(SQUARE[::-1], fan)
    assert not claim_checks.bounds_disk(SQUARE[[0, 2, 1, 3]], fan)
    assert not claim_checks.bounds_disk(0 * SQUARE, fan)


def test_what_lies_beyond_both_ends_is_a_factor() -> None:
    above, below = claim_checks.beyond(np.array([[1.0, 2.0, 4.0], [3.0, 3.0, 1.0], [2.0, 4.0, 2.0]]))
    assert above.tolist() == [1.5, 1.0, 1.0]
    assert below.tolist() == [1.0, 1.0, 2.0]


def test_change_that_all_triangles_share_is_not_local() -> None:
    assert claim_checks.in_a_tenth(np.outer(np.ones(20), [1.0, 2.0, 1.0])) == pytest.approx(0.1)
    assert claim_checks.in_a_tenth(np.outer(np.arange(20) == 3, [1.0, 2.0, 1.0])) == 1.0


def test_a_curve_is_measured_alike_twice_and_as_it_was() -> None:
    first, second = (claim_checks.work("curve: letter c") for _ in range(2))
    assert first == second
    assert first["swaps_valid"] == claim_checks.PARAMETERS["swaps"]
    assert first["flips"] == first["flips_larger"] > 0
    assert first["spines"] == first["spines_longest"] == 1 + claim_checks.PARAMETERS["draws"]
    assert first["slide_relative"] == 0 < first["linear_relative"]
