"""Arrays grow to twice their length and keep what they held."""

import numpy as np
import pytest

from tween.geometry.growing import longer, more_rows


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.float64])
def test_a_longer_array_begins_with_the_values(dtype: type) -> None:
    values = np.arange(1, 8).astype(dtype)
    grown = longer(values)
    assert (len(grown), grown.dtype) == (14, dtype)
    np.testing.assert_array_equal(grown[:7], values)
    grown[0] = 0
    assert values[0] == 1, "the old array is no part of the new one"


def test_more_rows_begin_with_the_rows() -> None:
    rows = np.arange(12).reshape(4, 3)
    grown = more_rows(rows)
    assert grown.shape == (8, 3)
    np.testing.assert_array_equal(grown[:4], rows)
