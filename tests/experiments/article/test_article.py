"""The article: set from the results, the same bytes twice, and every number in it is one of theirs."""

import re
import tomllib

import pandas as pd
import pytest

import experiments.claims.measure  # noqa: F401  its sections fill the ledger
from experiments.article.__main__ import SOURCE, article
from experiments.article.clauses import CLAUSES
from experiments.article.numbers import numbers, pinned
from experiments.claims import ledger
from experiments.claims.rules import CONDITION, HOLDS, VERDICTS
from experiments.report.references import REFERENCES
from experiments.store import RESULTS, ROOT

NUMBERS = numbers(RESULTS)
TEXT = SOURCE.read_text(encoding="utf-8")
TABLE = pd.read_csv(RESULTS / "claims.csv", keep_default_na=False)


def test_the_committed_article_is_what_the_results_give() -> None:
    assert article() == (RESULTS / "article.pdf").read_bytes(), "run `make article`"


def test_it_has_four_to_six_pages() -> None:
    assert 4 <= int(re.findall(rb"/Type ?/Pages ?/Count (\d+)", article())[0]) <= 6


def test_the_text_asks_for_every_number_and_no_other() -> None:
    asked = set(re.findall(r"\bn\.(\w+?)(?:\\_|\b)", TEXT))
    assert asked == set(NUMBERS)


def test_the_text_has_no_number_of_its_own_but_those_of_the_method() -> None:
    body = TEXT[TEXT.index("#align(center)") : TEXT.index("= References")]
    body = re.sub(
        r"width: \d+%|size: \d+pt|#v\([\d.]+em\)|x: 1.2em|== 0|2 pi|#figure\(.*?kind: table", "", body, flags=re.DOTALL
    )
    body = re.sub(r"(Section|Figure|rows?|Rows|Table) \d(\.\d)?( to \d)?|26 November 2026|1e-\d", "", body)
    # frames, vertices, bound of distortion, interval, reproduction within 20 %, t = 0.5, Python, "1 + arcs"
    assert set(re.findall(r"(?<![\w.])\d[\d.]*\d|(?<![\w.])\d", body)) == {
        "100",
        "61",
        "96",
        "4",
        "95",
        "20",
        "0.5",
        "3.11",
        "1",
    }


def test_it_refers_to_no_file_that_a_reader_does_not_have() -> None:
    for name in re.findall(r"(?:results|experiments)/[\w/]+\.\w+", TEXT):
        assert (ROOT / name).exists()
    assert "report" not in TEXT[TEXT.index("#align(center)") :]


def test_every_reference_is_cited_and_every_citation_is_there() -> None:
    cited = {name for group in re.findall(r"#cited\(([^)]*)\)", TEXT) for name in re.findall(r'"(\w+)"', group)}
    assert cited == set(REFERENCES)


def test_every_figure_and_table_is_referred_to() -> None:
    labels = set(re.findall(r"\) <(\w+)>", TEXT))
    assert len(labels) >= 10
    assert labels == set(re.findall(r"@(\w+)", TEXT))
    for name in re.findall(r'#picture\("(\w+)"', TEXT):
        assert (RESULTS / "figures" / f"{name}.pdf").exists()


# The ledger


def test_every_claim_has_a_clause() -> None:
    assert set(CLAUSES) == set(ledger.LEDGER) == set(TABLE["id"])


def test_claims_and_questions_are_counted_apart() -> None:
    claims = TABLE[TABLE["kind"] == ledger.CLAIM]
    assert (NUMBERS["asked"], NUMBERS["questions"]) == (len(claims), 3) == (39, 3)
    assert NUMBERS["verdicts"] == {v: int((claims["verdict"] == v).sum()) for v in VERDICTS}
    assert sum(NUMBERS["as_printed"].values()) == NUMBERS["asked"]
    assert NUMBERS["as_printed"][CONDITION] == 0
    assert NUMBERS["verdicts"][HOLDS] == NUMBERS["as_printed"][HOLDS]
    assert [row["id"] for row in NUMBERS["claims"]] == claims["id"].tolist()


def test_a_condition_stands_beside_every_claim_that_has_one() -> None:
    rows = {row["id"]: row for row in (*NUMBERS["claims"], *NUMBERS["answered"])}
    for row in TABLE.itertuples():
        shown = rows[row.id]
        assert shown["condition"] == row.condition.replace("`", "")
        assert bool(shown["under"]) == (row.verdict == CONDITION)
        assert "[" not in shown["cases"] + shown["under"]
        assert shown["as_printed"] == row.as_printed


# The other tables and numbers


def test_its_numbers_are_those_of_the_tables() -> None:
    rows = pd.read_csv(RESULTS / "matching.csv")
    assert NUMBERS["printed_bad"] == (rows[rows.method == "paper"].disks < 61).sum()
    slide = pd.read_csv(RESULTS / "pairs.csv").query("path == 'slide'")
    assert NUMBERS["swelling"] == f"{slide.swelling.median():.1f}"
    assert NUMBERS["least_flips"] == slide.flips.min() > 0  # no two curves are compatible
    rho = pd.read_csv(RESULTS / "quality.csv").query("scope == 'methods of one pair' and measure == 'AR_1e-4'")
    assert NUMBERS["rho_AR_invalid"] == f"{rho.set_index('quality').rho['invalid']:.2f}".replace("-", "−")


def test_what_another_path_and_placement_do_stands_between_printed_and_matched() -> None:
    summary = pd.read_csv(RESULTS / "matching_summary.csv").set_index(["method", "measure"])["median"]
    for (measure, word), row in zip(
        (("AR_1e-4", "AR"), ("Var", "Var"), ("swelling", "swelling"), ("path_length", "length")),
        NUMBERS["matching"],
        strict=True,
    ):
        assert row[0].startswith(word)
        wanted = [summary[method, measure] for method in ("paper", "paper_guaranteed", "matched")]
        assert [float(cell) for cell in row[1:4]] == pytest.approx(wanted, rel=0.05)


def test_what_remeshing_does_to_the_disk_is_that_of_the_grid() -> None:
    grid = pd.read_csv(RESULTS / "grid_disk.csv").query(
        "n == 96 and frames == 100 and path == 'slide' and pace == 'time'"
    )
    wide = grid.pivot(index="curve", columns="triangulation", values="AR_1e-9")
    row = next(row for row in NUMBERS["to_disk"] if row[:2] == ["slide", "AR at 1e-9"])
    counts = [
        (wide.remeshed < wide.uniform).sum(),
        (wide.remeshed == wide.uniform).sum(),
        (wide.remeshed > wide.uniform).sum(),
    ]
    assert row[2:5] == list(map(str, counts))
    assert sum(counts) == NUMBERS["grid_curves"] == NUMBERS["curves"] + NUMBERS["grid_added"]
    assert NUMBERS["fewer"] + NUMBERS["not_fewer"] == NUMBERS["grid_curves"]
    assert len(NUMBERS["to_disk"]) == 10


def test_samples_are_those_of_the_studies_parameters() -> None:
    assert (NUMBERS["grid_samples"], NUMBERS["layout_samples"]) == (24, 200)
    assert (NUMBERS["draws"], NUMBERS["random"]) == (40, "1,000")


def test_frames_of_the_guarantee_are_morphs_times_paths_times_61() -> None:
    morphs, paths = NUMBERS["safe_morphs"], NUMBERS["safe_paths"]
    assert NUMBERS["safe_frames"] == f"{morphs * paths * 61:,}"


def test_the_paper_s_columns_are_as_printed() -> None:
    assert NUMBERS["columns"][0][1:] == ["7 and 31", "17 and 42", "10 and 13", "23 and 36"]
    cells = pd.read_csv(RESULTS / "grid_columns.csv").query("row == 1")
    assert NUMBERS["columns"][4][1] == f"{cells['both'].sum()} of {cells['cells'].sum():,}"
    assert NUMBERS["row_1_split"] < NUMBERS["row_1_near"] == cells["both"].sum()


@pytest.mark.parametrize("name", pinned())
def test_versions_are_those_of_the_lock(name: str) -> None:
    assert f"{name}=={pinned()[name]}" in (ROOT / "requirements.lock").read_text(encoding="utf-8")


def test_the_version_is_that_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert NUMBERS["version"] == project["version"]
