"""Arrays that grow, for compiled kernels.

Plain loops, as numba compiles array expressions into code many times as long, and that into every kernel that has one.
"""

import numpy as np
from numba import njit


@njit(cache=True)
def longer(values):
    """The values, (k,), at the start of an array twice as long: so moving costs O(1) an entry in all."""
    grown = np.empty(2 * len(values), values.dtype)
    for i in range(len(values)):
        grown[i] = values[i]
    return grown


@njit(cache=True)
def more_rows(rows):
    """The same for rows, (k, c)."""
    grown = np.empty((2 * rows.shape[0], rows.shape[1]), rows.dtype)
    for i in range(rows.shape[0]):
        for s in range(rows.shape[1]):
            grown[i, s] = rows[i, s]
    return grown
