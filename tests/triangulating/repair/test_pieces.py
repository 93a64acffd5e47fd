"""Pieces of a stroke that may be dropped: what was planted is found, and nothing else."""

import numpy as np
import pytest

from tween.triangulating.repair.pieces import droppable, tidied
from tween.triangulating.repair.smoothing import Path

RADIUS = 0.1


def closed(corners):
    """Evenly spaced points along a closed polygon, a quarter of the radius apart."""
    p = np.array(corners, dtype=float)
    path = Path(p, np.arange(len(p), dtype=float), float(len(p)))
    x = path.evenly(int(np.ceil(4 * path.length / RADIUS)))
    return path, x


def found(corners, reach=RADIUS):
    path, x = closed(corners)
    return [(piece.kind, piece.first, piece.last) for piece in droppable(x, path, RADIUS, reach)]


def test_a_plain_square_has_nothing_to_drop():
    assert found([[0, 0], [4, 0], [4, 4], [0, 4]]) == []


def test_a_short_spike_is_found_where_it_is():
    stroke = [[0, 0], [2, 0], [2.005, -0.17], [2.01, 0], [4, 0], [4, 4], [0, 4]]
    ((kind, first, last),) = found(stroke, reach=0.2)
    assert kind == "spike" and 0.9 < first < 2 < last < 3.1
    assert found(stroke) == []  # it reaches farther than was asked


def test_a_tiny_loop_is_found_and_a_large_one_is_not():
    t = np.linspace(0, 2 * np.pi, 13)[:-1]

    def with_loop(r):
        loop = np.stack([2 + r * np.sin(t), r * (1 - np.cos(t))], axis=1) * [1, -1]
        return [[0, 0], *loop.tolist(), [2.001, 0], [4, 0], [4, 4], [0, 4]]

    assert [kind for kind, *_ in found(with_loop(0.03))] == ["loop"]
    assert found(with_loop(0.8)) == []


def test_what_is_drawn_there_and_back_is_found_though_it_is_long():
    ((kind, first, last),) = found([[0, 0], [3, 0], [1, 0.02], [4, 0.04], [4, 4], [0, 4]])
    assert kind == "retraced" and first < last


@pytest.mark.parametrize("seed", range(5))
def test_pieces_do_not_overlap(seed):
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    p = np.stack([np.cos(t), np.sin(t)], axis=1) + rng.normal(scale=0.04, size=(400, 2))
    path = Path(p, np.arange(400.0), 400.0)
    x = path.evenly(int(np.ceil(4 * path.length / RADIUS)))
    pieces = droppable(x, path, RADIUS, RADIUS)
    dropped = sum(path.between(piece.first, piece.last).astype(int) for piece in pieces)
    assert len(pieces) and np.max(dropped) <= 1


def test_repetitions_and_exact_spikes_go_until_none_is_left():
    p = np.array([[0.0, 0], [0, 0], [2, 0], [3, 0], [2, 0], [2, 2], [2, 2], [0, 2]])
    assert p[tidied(p)].tolist() == [[0, 0], [2, 0], [2, 2], [0, 2]]
    there_and_back = np.array([[0.0, 0], [1, 0], [2, 0], [1, 0]])
    assert len(tidied(there_and_back)) < 3
