"""Set the article: article.typ has the words, `.numbers` the numbers; the same results give the same bytes."""

import json

import typst

from experiments.article.numbers import numbers
from experiments.store import RESULTS, ROOT, replacing

SOURCE = ROOT / "experiments" / "article" / "article.typ"


def article() -> bytes:
    """The article as PDF.  Its date is fixed, and it uses the fonts that come with typst alone."""
    facts = json.dumps(numbers(RESULTS))
    pdf = typst.compile(SOURCE, root=ROOT, sys_inputs={"numbers": facts}, ignore_system_fonts=True, timestamp=0)
    assert isinstance(pdf, bytes)
    return pdf


def main() -> None:
    pdf = article()
    with replacing(RESULTS / "article.pdf") as temporary:
        temporary.write_bytes(pdf)
    print(f"article: {len(pdf) / 1e6:.1f} MB -> results/article.pdf")


if __name__ == "__main__":
    main()
