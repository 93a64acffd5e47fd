"""What `tween play` hands to the server; the page itself is tested where it stands."""

from typing import Any

import pytest
from terminal import COMMANDS, Run

from tween import gallery
from tween.app.playground import page


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What would have been served."""
    seen: list[Any] = []
    monkeypatch.setattr(page, "serve", lambda curve, port, browser: seen.append((curve, port, browser)))
    return seen


def test_every_example_of_the_help_is_understood(run: Run, served: list[Any]) -> None:
    assert run("gallery loop -o drawing.svg")[0] == 0
    lines = [line.strip() for line in (COMMANDS["play"].epilog or "").splitlines() if line.startswith("  tween ")]
    assert len(lines) == 3
    for line in lines:
        assert run(line.removeprefix("tween ")) == (0, "", "")
    assert [(curve and len(curve), port, browser) for curve, port, browser in served] == [
        (None, None, True),
        (len(gallery.curve("arrow")), None, True),
        (len(gallery.curve("loop")), 8866, False),
    ]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("play none.csv", "none.csv: No such file"),
        ("play gallery:arrw", "did you mean 'arrow'"),
        ("play --port 0", "1<=x<=65535"),
        ("play --port http", "not a valid int"),
        ("play --ip 0.0.0.0", "No such option"),
        ("play a.svg b.svg", "unexpected extra argument"),
    ],
)
def test_what_cannot_be_played_is_said_in_one_line_before_anything_is_served(
    line: str, words: str, run: Run, served: list[Any]
) -> None:
    status, out, err = run(line)
    assert (status, out, err.count("\n"), served) == (2, "", 1, [])
    assert words in err


def test_what_is_missing_is_said_with_the_extra_that_has_it(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page.importlib.util, "find_spec", lambda name: None)
    status, out, err = run("play")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "needs voila and anywidget and ipywidgets: pip install '.[play]'" in err
