"""What a matching is given: a start that does not depend on the input's, and landmarks that make sense."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.gallery import curve, random_disk
from tween.morphing.matching.given import Given, _least_rotation, checked_landmarks


@given(st.lists(st.integers(0, 2), min_size=1, max_size=12))
def test_the_least_rotation_is_the_first_of_all_in_the_dictionary(word: list[int]) -> None:
    start = _least_rotation(word)
    assert word[start:] + word[:start] == min(word[k:] + word[:k] for k in range(len(word)))


@pytest.mark.parametrize("shift", [1, 5, 11])
def test_a_similar_curve_that_starts_elsewhere_is_numbered_alike(shift: int) -> None:
    points = random_disk(12, np.random.default_rng(3)).points
    moved = np.roll(points, -shift, axis=0) @ [[0.0, 3.0], [-3.0, 0.0]] + 5
    plain, other = Given(points, "source"), Given(moved, "source")
    assert plain.key == other.key
    assert ((other.rows + shift) % 12).tolist() == plain.rows.tolist()


def test_every_disk_that_a_curve_bounds_is_tried_and_a_triangulation_says_which() -> None:
    both = Given(curve("two_disks"), "source")
    assert len(both.disks) == 2
    assert len(Given(both.disks[1], "source").disks) == 1


def test_a_curve_that_bounds_no_disk_is_named() -> None:
    with pytest.raises(NotSelfOverlappingError, match="the target bounds no immersed disk: turning number is 0"):
        Given([(0, 0), (2, 2), (2, 0), (0, 2)], "target")


SQUARE = [(0, 0), (3, 0), (3, 2), (0, 2)]


@pytest.mark.parametrize(
    ("landmarks", "message"),
    [
        ([(0, 4)], "out of range: the target has vertices 0 to 3"),
        ([(-1, 0)], "out of range: the source has vertices 0 to 3"),
        ([(0, 1), (0, 2)], "both use vertex 0 of the source"),
        ([(0, 0), (1, 2), (2, 1)], "not in the same order around both curves"),
        ([(0.5, 1)], "expected pairs of whole numbers"),
        ([(0, 1), (2,)], "expected pairs of whole numbers"),
        ("ab", "expected pairs of whole numbers"),
    ],
)
def test_landmarks_that_make_no_sense_are_refused_with_the_reason(landmarks, message: str) -> None:
    with pytest.raises(IncompatibleError, match=message):
        checked_landmarks(landmarks, Given(SQUARE, "source"), Given(SQUARE, "target"))


def test_landmarks_come_back_in_order_and_in_the_numbers_of_the_shapes() -> None:
    source, target = Given(SQUARE, "source"), Given(SQUARE, "target")
    pairs = checked_landmarks([(3, 0), (1, 2)], source, target)
    assert (np.diff(pairs[:, 0]) > 0).all()
    rows = {(int(source.rows[i]), int(target.rows[j])) for i, j in pairs}
    assert rows == {(3, 0), (1, 2)}
    assert checked_landmarks(None, source, target).shape == (0, 2)
