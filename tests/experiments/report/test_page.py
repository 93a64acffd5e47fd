"""The report: everything is on the page, nothing is fetched, numbers come from results/, and gaps are named."""

import json
import shutil
from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
import pytest

from experiments.catalogue import STEPS, writer
from experiments.claims.rules import ORIGIN, RULES, TOGETHER
from experiments.report import facts, tables
from experiments.report import page as report
from experiments.report.__main__ import main
from experiments.report.references import REFERENCES
from experiments.store import FIGURES, RESULTS, ROOT

VOID = {"meta", "input", "img", "wbr", "br", "link"}


class Reader(HTMLParser):
    """Takes a page apart: which elements stay open, ids, addresses, and the words."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.addresses: list[str] = []
        self.pictures: list[dict[str, str | None]] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        about = dict(attrs)
        self.ids += [about["id"] or ""] if "id" in about else []
        self.addresses += [about[key] or "" for key in ("href", "src", "action", "data") if key in about]
        if tag == "img":
            self.pictures.append(about)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.words += data


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of the results with a ledger of two claims, one awkward to write in HTML, and an open question."""
    folder = tmp_path_factory.mktemp("project") / "results"
    shutil.copytree(RESULTS, folder, ignore=shutil.ignore_patterns("animations", "*.pdf", "*.html"))
    columns = [
        "id",
        "section",
        "kind",
        "claim",
        "rule",
        "as_printed",
        "verdict",
        "number",
        "interval",
        "p",
        "condition",
        "evidence",
        "figure",
    ]
    figure = next(iter(json.loads((FIGURES / "captions.json").read_text(encoding="utf-8"))))
    rows = [
        [
            "one",
            "4",
            "claim",
            "It holds",
            "more: a curve",
            "holds",
            "holds",
            "7 of 7",
            "7 of 7 (0.65 to 1)",
            "0.016",
            "",
            "experiments/studies/to_disk.py; tests/no_such.py::test_it",
            f"{figure}.png",
        ],
        [
            "two",
            "5",
            "claim",
            'A "<b>" & <script>',
            "every: all",
            "fails",
            "holds under a condition",
            "u < 1e-4",
            "1 of 2 (0 to 1)",
            "",
            "with `x`",
            "README.md",
            "",
        ],
        [
            "three",
            "7",
            "open question",
            "What is wanted",
            "more: our answer",
            "holds",
            "holds",
            "3 of 3",
            "3 of 3 (0 to 1)",
            "",
            "",
            "README.md",
            "",
        ],
    ]
    pd.DataFrame(rows, columns=columns).to_csv(folder / "claims.csv", index=False)
    return folder


@pytest.fixture
def bare(results: Path, tmp_path: Path) -> Path:
    """Return another copy, without figures, which take time to embed."""
    copy = tmp_path / "results"
    shutil.copytree(results, copy, ignore=shutil.ignore_patterns("*.png"))
    (copy / "figures" / "captions.json").write_text("{}")
    return copy


@pytest.fixture(scope="module")
def text(results: Path) -> str:
    """Return the page."""
    return report.page(results, times=results / "no_times.json")


@pytest.fixture(scope="module")
def page(text: str) -> Reader:
    """Return the page, taken apart."""
    return Reader(text)


def test_the_page_is_sound(text: str, page: Reader) -> None:
    assert text.startswith("<!DOCTYPE html>")
    assert page.open == []
    assert len(page.ids) == len(set(page.ids))


def test_the_page_fetches_nothing(text: str, page: Reader) -> None:
    assert [a for a in page.addresses if not a.startswith(("#", "data:", "../", "figures/"))] == []
    for word in ("<script", "<link", "@import", "url(", "http:", "https:"):
        assert word not in text


def test_every_link_leads_somewhere(page: Reader) -> None:
    anchors = {a.removeprefix("#") for a in page.addresses if a.startswith("#")}
    assert anchors
    assert anchors <= set(page.ids)
    for address in page.addresses:
        if address.startswith(("../", "figures/")):
            assert (RESULTS / address).exists(), address


def test_the_page_has_every_figure_in_the_papers_order(page: Reader) -> None:
    captions = json.loads((FIGURES / "captions.json").read_text(encoding="utf-8"))
    order = [name for name in page.ids if name in captions]
    assert sorted(order) == sorted(captions)
    kinds = [captions[name]["of"] for name in order]
    kinds = [kind.partition(",")[0] for kind in kinds]  # "Figure 10, continued"
    numbers = [int(kind.split()[1]) for kind in kinds if kind.startswith("Figure")]
    first = kinds.index("Figure 1")
    assert kinds[first : first + len(numbers)] == [f"Figure {number}" for number in sorted(numbers)]
    for picture in page.pictures:
        assert (picture["src"] or "").startswith("data:image/")
        assert picture["alt"] and picture["width"] and picture["height"]
    for about in captions.values():
        assert about["caption"].replace("`", "")[:40] in page.words


def test_every_figure_leads_to_the_code_that_draws_it(page: Reader) -> None:
    captions = json.loads((FIGURES / "captions.json").read_text(encoding="utf-8"))
    for name in captions:
        code = report.code_of(name)
        assert f'"{name}"' in (ROOT / code).read_text(encoding="utf-8")
        assert f"../{code}" in page.addresses


def test_the_rules_stand_before_the_verdicts_and_what_is_not_known_after_them(page: Reader) -> None:
    order = [
        page.ids.index(part) for part in ("introduction", "methods", "claims", "limitations", "references", "made")
    ]
    assert order == sorted(order)
    for words in (*RULES.values(), TOGETHER, ORIGIN, *REFERENCES.values()):
        assert words in page.words


def test_the_page_has_every_cell_of_table_1(page: Reader, results: Path) -> None:
    table = tables.as_written(results / "table_1.csv")
    assert len(table) > 10
    for cell in table.to_numpy().ravel():
        assert cell.replace("_", " ") in page.words


def test_the_page_is_of_a_size_that_can_be_sent(text: str) -> None:
    assert len(text.encode()) < 8e6


def test_claims_are_quoted_and_counted(text: str, page: Reader) -> None:
    assert 'A "<b>" & <script>' in page.words
    assert (
        "Of 2 claims of the paper 1 hold, 1 hold under a condition, 0 hold weakly, 0 show no difference and 0 fail"
        in page.words
    )
    assert "as printed 1 hold and 1 do not" in page.words
    assert "As printed it fails." in page.words
    assert page.words.count("Open question") == 1
    assert "<code>x</code>" in text
    assert "7 of 7 (0.65 to 1); sign test, p: 0.016." in page.words
    assert "1 of 2 (0 to 1)." in page.words
    assert 'href="../experiments/studies/to_disk.py"' in text
    assert "tests/no_such.py::test_it" in page.words
    assert "no_such.py" not in " ".join(page.addresses)


def test_versions_seeds_and_commands_are_named(page: Reader) -> None:
    for word in ("numpy", "numba", "Python", "seed = ", "samples = ", "make reproduce", "experiments.report"):
        assert word in page.words


def test_times_are_shown_where_they_were_measured(text: str, bare: Path, tmp_path: Path) -> None:
    assert "Not measured" in text
    times = tmp_path / "times.json"
    times.write_text(json.dumps([{"step": "a slow step", "seconds": 61.2}, {"step": "another", "seconds": 2.0}]))
    words = Reader(report.page(bare, times)).words
    assert "a slow step" in words
    assert "63" in words
    assert "Not measured" not in words


def test_the_abstract_follows_the_results() -> None:
    table = pd.read_csv(RESULTS / "table_1_to_disk.csv")
    before = facts.against_median(table, "AR_1e-4", "slide")
    own = (table.path == "slide") & (table.triangulation == "remeshed")
    table.loc[own, "AR_1e-4"] = 10**6
    after = facts.against_median(table, "AR_1e-4", "slide")
    assert before != after == {"below": 0, "above": int(own.sum()), "gap": after["gap"], "p": after["p"]}
    assert float(after["p"]) < 1e-6


@pytest.mark.parametrize("file", report.NEEDED)
def test_a_missing_file_is_named_with_the_study_to_run(
    file: str, bare: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (bare / file).unlink()
    assert main(bare) == 1
    message = capsys.readouterr().err
    assert f"results/{file}" in message
    assert writer(file).command in message
    assert not (bare / "report.html").exists()


def test_the_page_is_written_and_its_place_is_told(bare: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(bare) == 0
    assert capsys.readouterr().out.endswith(f"open {bare / 'report.html'}\n")
    assert Reader((bare / "report.html").read_text(encoding="utf-8")).pictures == []


def test_a_missing_picture_is_named(tmp_path: Path) -> None:
    with pytest.raises(report.MissingResultsError, match=r"no_such\.png is missing: run `python -m experiments"):
        report.embedded(tmp_path / "no_such.png")


@pytest.mark.parametrize("study", tables.KEYS)
def test_a_study_without_results_is_left_out_with_a_word(study: str, bare: Path) -> None:
    file = next(step for step in STEPS if step.name == study).results[0]
    (bare / file).unlink(missing_ok=True)
    found = {key.name: key.table for key in tables.key_tables(bare)}
    assert found[study] is None
    assert [name for name, table in found.items() if table] != []


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Section 6, Figures 9 and 10.", {"Section 6", "Figure 9", "Figure 10"}),
        (
            "Sections 1 to 3, Figures 4, 6, 7 and 8",
            {"Section 1", "Section 2", "Section 3", "Figure 4", "Figure 6", "Figure 7", "Figure 8"},
        ),
        ("Section 4.1 and Table 1.", {"Section 4.1", "Table 1"}),
        ("ours", set()),
    ],
)
def test_places_of_the_paper_are_read(text: str, found: set[str]) -> None:
    assert report.places(text) == found
