"""What cleaning says that it changed."""

import json

import pytest

from tween.triangulating.repair.changes import Changes, Dropped

PLAIN = Changes(asked=0.1, smoothing=0.05, tremor=0.01, moved=0.08, gap=0.0, close=0.2, dropped=(), rows=100, reason="")


def with_pieces(*pieces):
    return Changes(**{**vars(PLAIN), "dropped": pieces})


def piece(kind, first=3.0, last=4.0, reach=0.05):
    return Dropped(kind, first, last, (1.0, 2.0), reach)


def test_a_change_within_what_was_asked_says_so():
    assert PLAIN.within and PLAIN.beyond == () and PLAIN.bounds_disk
    assert str(PLAIN).splitlines() == ["smoothed by 0.05 of 0.1 allowed: moved by 0.08 at most", "bounds a disk"]


def test_what_moved_farther_is_told():
    far = Changes(**{**vars(PLAIN), "moved": 0.11})
    assert not far.within
    assert "more than was asked: the curve is up to 0.11 from the stroke" in str(far)


@pytest.mark.parametrize(("kind", "within"), [("spike", False), ("loop", False), ("end", True)])
def test_a_dropped_piece_may_reach_as_far_as_was_asked_and_an_end_as_far_as_ends_are_sought(kind, within):
    found = with_pieces(piece(kind, reach=0.15))
    assert found.within == within
    assert (f"the {kind} at (1, 2) reached out by 0.15" in str(found)) != within


def test_a_last_bit_is_not_more_than_was_asked():
    assert Changes(**{**vars(PLAIN), "moved": 0.1 * (1 + 1e-12)}).within


def test_pieces_are_counted_by_kind_and_named_in_the_plural():
    found = with_pieces(*[piece("retraced", first=k) for k in range(5)], piece("repetition", first=7.5))
    assert (found.count("retraced"), found.count("repetition"), found.count("loop")) == (5, 1, 0)
    assert "dropped 5 retraced pieces at rows 0, 1, 2, ..." in str(found)
    assert "dropped 1 repeated point at row 7.5" in str(found)


def test_a_wide_gap_and_a_curve_that_bounds_nothing_are_said():
    text = str(Changes(**{**vars(PLAIN), "gap": 0.5, "reason": "turning number is 2, not 1", "smoothing": 0.0}))
    assert text.splitlines() == [
        "not smoothed; moved by 0.08 at most",
        "ends joined across a gap of 0.5, more than the 0.2 up to which ends are sought",
        "bounds no disk: turning number is 2, not 1",
    ]


def test_the_dictionary_is_plain_and_complete():
    found = with_pieces(piece("loop"))
    plain = json.loads(json.dumps(found.to_dict()))
    assert plain["dropped"] == [{"kind": "loop", "first": 3, "last": 4, "place": [1, 2], "reach": 0.05}]
    assert set(vars(PLAIN)) | {"bounds_disk", "beyond"} == set(plain)
