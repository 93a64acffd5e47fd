"""Many frames: at once, by blocks, one by one, and in a memory map."""

from pathlib import Path

import numpy as np
import pytest

from tween import decompose, gallery, morph
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
