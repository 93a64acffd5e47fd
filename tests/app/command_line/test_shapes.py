"""Shapes are read as people name them: files first, and what may be meant is said."""

from pathlib import Path

import numpy as np
import pytest

import tween
from tween import gallery
from tween.app.command_line.shapes import Reading, read_points, read_shape
from tween.errors import CurveError, FileError


def test_a_file_goes_before_a_curve_of_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileError, match="no file 'ell'; the curve that comes with tween is gallery:ell"):
        read_shape("ell")
    Path("ell").write_text("0,0\n1,0\n1,1\n")
    with pytest.raises(FileError, match=r"^ell: has the suffix ''"):
        read_shape("ell")


def test_a_stroke_that_is_no_curve_can_be_cleaned(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    points = np.insert(gallery.curve("ell").points, 7, gallery.curve("ell").points[5], axis=0)  # there, and back
    np.savetxt("spiked.csv", points, delimiter=",")
    with pytest.raises(CurveError, match=r"^spiked.csv: .*spike"):
        read_shape("spiked.csv")
    cleaned = read_shape("spiked.csv", how=Reading(smooth=0.3)).curve
    assert np.array_equal(cleaned.points, tween.clean(points, 0.3).points)
    assert capsys.readouterr().err.startswith("tween: note: spiked.csv: ")
    assert np.array_equal(read_points("spiked.csv"), points)


def test_a_curve_that_comes_with_tween_is_cleaned_like_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    cleaned = read_shape("gallery:pretzel", how=Reading(smooth=0.1)).curve
    assert np.array_equal(cleaned.points, tween.clean(gallery.curve("pretzel"), 0.1).points)
    assert capsys.readouterr().err.startswith("tween: note: gallery:pretzel: smoothed by ")


def test_a_fault_carries_the_first_line_of_the_explanation() -> None:
    shape = read_shape("M0 0L20 20L20 0L0 20Z")
    summary = tween.decompose(shape.curve).explain().summary
    assert str(shape.fault()) == f"path data M0 0L20 20L20 0L0 20Z: t{summary[1:]}"
