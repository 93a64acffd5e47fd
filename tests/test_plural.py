"""Counts in words."""

import pytest

from tween.plural import counted


@pytest.mark.parametrize(("number", "words"), [(0, "no holes"), (1, "1 hole"), (2, "2 holes"), (1000, "1000 holes")])
def test_one_is_not_many_and_none_is_said(number: int, words: str) -> None:
    assert counted(number, "hole") == words
