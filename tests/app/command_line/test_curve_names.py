"""Names of the curves that come with tween, and files, understood as people type them."""

import json
import re
from itertools import chain

import numpy as np
import pytest
from terminal import Run

from tween import gallery, io
from tween.app.command_line import curve_names
from tween.errors import TweenError


def test_the_gallery_lists_everything_by_names_that_are_understood(run: Run) -> None:
    status, out, _ = run("gallery")
    assert status == 0
    listed = json.loads(run("gallery --json")[1])
    assert {part: len(entries) for part, entries in listed.items()} == {
        "curves": len(gallery.names()),
        "letters": len(gallery.letters()),
        "pairs": len(gallery.pairs()),
    }
    for entry in chain.from_iterable(listed.values()):
        assert re.search(rf"^  {re.escape(entry['name'])} .*{re.escape(entry['about'])}$", out, re.MULTILINE)
        ends = ("/source", "/target") if isinstance(entry["vertices"], list) else ("",)
        found = [len(curve_names.named(entry["name"] + end)) for end in ends]
        assert found == np.atleast_1d(entry["vertices"]).tolist()


@pytest.mark.parametrize("word", ["gallery:ell", "ell", "letter:S", "S", "pair:e_to_l/target", "e_to_l/target", ":"])
def test_a_curve_of_the_gallery_is_written(word: str, run: Run) -> None:
    entry = json.loads(run(f"gallery {word} -o out.json --json")[1])
    assert entry["written"] == "out.json"
    curve = io.read_curve("out.json")
    assert len(curve) == entry["vertices"]
    assert np.array_equal(curve.points, curve_names.named(entry["name"]).points)


EVERY = [
    *gallery.names(),
    *gallery.letters(),
    *(f"{pair}/{end}" for pair in gallery.pairs() for end in ("source", "target")),
]


@pytest.mark.parametrize("name", EVERY)
def test_the_full_name_of_a_curve_is_found_from_its_short_one_and_stays(name: str) -> None:
    full = curve_names.full_name(name)
    assert full.endswith(f":{name}")
    assert curve_names.full_name(full) == full
    described = curve_names.describe(full)
    assert described["name"] == full
    assert described["vertices"] == len(curve_names.named(full))


def test_the_two_ends_of_a_pair_are_its_curves_in_order() -> None:
    for name in gallery.pairs():
        for end, curve in zip(("source", "target"), gallery.pair(name), strict=True):
            assert np.array_equal(curve_names.named(f"pair:{name}/{end}").points, curve.points)


@pytest.mark.parametrize("word", ["gallery:square", "letter:ab", "pair:none/source", "pair:e_to_l", "gallery:"])
def test_what_does_not_come_with_tween_is_refused(word: str) -> None:
    with pytest.raises(TweenError):
        curve_names.named(word)


def test_the_listing_has_a_line_for_each_in_columns() -> None:
    lines = [line for line in curve_names.listing().splitlines() if line.startswith("  ")]
    entries = list(chain.from_iterable(curve_names.everything().values()))
    assert [line.split()[0] for line in lines] == [entry["name"] for entry in entries]
    assert len({line.index(entry["about"]) for line, entry in zip(lines, entries, strict=True)}) == 1


def test_every_name_is_the_name_of_a_curve() -> None:
    assert [name.partition(":")[2] for name in curve_names.every_name()] == EVERY
    assert all(curve_names.is_full(name) for name in curve_names.every_name())
    assert not any(map(curve_names.is_full, ["gallery", "ell", "a:b", "-", "M0 0", ":"]))
