"""The article: set from the results, the same bytes twice, and every number in it is one of theirs."""

import re

import pandas as pd
import pytest

from experiments.article.__main__ import SOURCE, article
from experiments.article.numbers import numbers, pinned
from experiments.claims.rules import VERDICTS
from experiments.store import RESULTS, ROOT

NUMBERS = numbers(RESULTS)
TEXT = SOURCE.read_text(encoding="utf-8")


def test_the_committed_article_is_what_the_results_give() -> None:
    assert article() == (RESULTS / "article.pdf").read_bytes(), "run `make article`"


def test_the_text_asks_for_every_number_and_no_other() -> None:
    asked = set(re.findall(r"\bn\.(\w+?)(?:\\_|\b)", TEXT))
    assert asked == set(NUMBERS)


def test_the_text_has_no_number_of_its_own_but_those_of_the_method() -> None:
    body = TEXT[TEXT.index("#align(center)") : TEXT.index("= References")]
    body = re.sub(r"#picture\(.*", "", re.sub(r"#figure\(.*?\n\) <\w+>", "", body, flags=re.DOTALL))
    body = re.sub(r"\(Shor and Van Wyk 1992\)|size: \d+pt|#v\([\d.]+em\)|x: 1.2em|@table1|== 0|2 pi", "", body)
    assert set(re.findall(r"(?<![\w.])\d[\d.,]*", body)) == {"100", "61", "3.11", "1"}  # frames, Python, "Table 1"


def test_the_figures_of_the_article_are_drawn_by_the_code_it_names() -> None:
    found = re.findall(r'#picture\("(\w+)", .*?, "(experiments/[\w/]+\.py)"', TEXT)
    assert len(found) >= 4
    for name, code in found:
        assert (RESULTS / "figures" / f"{name}.pdf").exists()
        assert f'"{name}"' in (ROOT / code).read_text(encoding="utf-8")


def test_its_numbers_are_those_of_the_tables() -> None:
    claims = pd.read_csv(RESULTS / "claims.csv")
    assert NUMBERS["verdicts"] == {v: int((claims.verdict == v).sum()) for v in VERDICTS}
    rows = pd.read_csv(RESULTS / "matching.csv")
    medians = rows.groupby("method")["AR_1e-4"].median()
    assert NUMBERS["matching"][0][1:3] == [f"{medians['paper']:.3g}", f"{medians['matched']:.3g}"]
    assert NUMBERS["printed_bad"] == (rows[rows.method == "paper"].disks < 61).sum()
    slide = pd.read_csv(RESULTS / "pairs.csv").query("path == 'slide'")
    assert NUMBERS["swelling"] == f"{slide.swelling.median():.1f}"
    rho = pd.read_csv(RESULTS / "quality.csv").query("scope == 'methods of one pair' and measure == 'AR_1e-4'")
    assert NUMBERS["rho_AR_invalid"] == f"{rho.set_index('quality').rho['invalid']:.2f}"


@pytest.mark.parametrize("name", pinned())
def test_versions_are_those_of_the_lock(name: str) -> None:
    assert f"{name}=={pinned()[name]}" in (ROOT / "requirements.lock").read_text(encoding="utf-8")
