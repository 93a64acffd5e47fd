"""Many frames: at once, by blocks, one by one, and in a memory map."""

from pathlib import Path

import numpy as np
import pytest

from tween import (
    decompose,
    gallery,
    morph,
    remesh,
)
from tween.gallery import random_disk
from tween.measuring import metrics
from tween.morphing import morph as morph_module


def test_many_frames_are_the_same_by_blocks_one_by_one_and_in_a_memory_map(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    T = decompose(gallery.curve("horseshoe")).arbitrary()
    m = morph(T, T.on_disk())
    frames, A = m.frames(23), metrics.area_matrix(m, 23)
    monkeypatch.setattr(morph_module, "_AT_ONCE", 5 * len(T))
    monkeypatch.setattr(metrics, "_AT_ONCE", 300)
    np.testing.assert_array_equal(m.frames(23), frames)
    np.testing.assert_array_equal(list(m.each_frame(23)), frames)
    mapped = np.lib.format.open_memmap(tmp_path / "frames.npy", "w+", shape=frames.shape)
    np.testing.assert_array_equal(m.frames(23, out=mapped), frames)
    areas = np.lib.format.open_memmap(tmp_path / "areas.npy", "w+", shape=A.shape)
    np.testing.assert_array_equal(metrics.area_matrix(m, 23, out=areas), A)
    values = np.linalg.svd(A, compute_uv=False)
    np.testing.assert_allclose(metrics.singular_values(areas), values, atol=1e-14 * values[0])
    with pytest.raises(ValueError, match="1 frames were asked for"):
        next(m.each_frame(1))


ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]


some_disks = [remesh(random_disk(30, np.random.default_rng(seed))) for seed in range(6)]


def test_a_shape_at_one_time_is_that_among_many() -> None:
    m = morph(some_disks[1], some_disks[1].on_disk())
    frames = m.frames(11)
    for t, frame in zip(np.linspace(0, 1, 11), frames, strict=True):
        np.testing.assert_array_equal(m(t), frame)
    np.testing.assert_array_equal(m.at([0.7, 0.2, 0.7]), [m(0.7), m(0.2), m(0.7)])
    assert m.at([]).shape == (0, 30, 2)
    assert m.events == []
    assert repr(m) == "Morph(30 vertices, 0 flips)"


@pytest.mark.parametrize("times", [[-0.1], [0.5, 1.1], [float("nan")], [float("inf")], 0.5, [[0.5]]])
def test_times_outside_the_morph_are_refused(times) -> None:
    m = morph(ELL, ELL)
    with pytest.raises(ValueError, match="from 0 to 1"):
        m.at(times)
