"""Triangles for frames that come without: found once, and checked by others."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import NotSelfOverlappingError
from tween.measuring.certificate import verify
from tween.triangulating.decomposition import decompose


def find_triangles(frames: ArrayLike) -> NDArray[np.int64]:
    """Find triangles that show frames to be immersed disks, and straight motion between them, too, if they can.

    Parameters
    ----------
    frames : array_like, shape (k, n, 2)
        Vertices in order along the curve, counter-clockwise.

    Returns
    -------
    ndarray of int64, shape (k, n-2, 3)
        As `tween.verify` takes them: it decides.  A list is kept as long as it holds.

    Raises
    ------
    NotSelfOverlappingError
        Where a frame bounds no immersed disk; the message says which and why.
    CurveError
        Where a frame is no polygon.

    Notes
    -----
    Where the last list does not hold until the next frame, one that is valid in both frames is taken, if there is
    one; of several, any.  So it may be that straight motion under these triangles breaks, and others would hold.
    Each time that costs a table, see `tween.decompose`.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> find_triangles([square, square]).shape
    (2, 2, 3)
    """
    shapes = np.asarray(frames, dtype=np.float64)
    lists: list[NDArray[np.int64]] = []
    for f in range(len(shapes)):
        pair = shapes[[f, min(f + 1, len(shapes) - 1)]]
        if not lists or not verify(pair, lists[-1], between="linear"):
            lists.append(_valid_in_both(pair, f))
        else:
            lists.append(lists[-1])
    return np.stack(lists)


def _valid_in_both(pair: NDArray[np.float64], f: int) -> NDArray[np.int64]:
    alone = decompose(pair[0])
    if not alone:
        raise NotSelfOverlappingError(f"frame {f} bounds no immersed disk: {alone.reason}")
    both = decompose(*pair)
    return (both or alone).arbitrary().triangles
