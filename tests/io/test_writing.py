"""What is written is read back exactly."""

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from strategies import exact_doubles

from tween import gallery
from tween.errors import CurveError
from tween.geometry.curve import Curve
from tween.io.reading import read_curve, read_curves
from tween.io.writing import write_curve, write_triangulation
from tween.triangulating.decomposition import triangulate

CURVE_SUFFIXES = (".svg", ".csv", ".json", ".geojson", ".npz", ".npy")
FEW = settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])


@pytest.mark.parametrize("suffix", CURVE_SUFFIXES)
@FEW
@given(points=st.lists(st.tuples(exact_doubles, exact_doubles), min_size=3, max_size=8))
def test_a_curve_is_read_back_exactly(tmp_path, suffix, points):
    try:
        curve = Curve(points)
    except CurveError:
        assume(False)
    path = write_curve(tmp_path / f"curve{suffix}", curve)
    assert np.array_equal(read_curve(path).points, curve.points)
    assert [p.points.tolist() for p in read_curves(path).values()] == [curve.points.tolist()]


@pytest.mark.parametrize("suffix", CURVE_SUFFIXES)
def test_a_curve_of_the_gallery_is_read_back_exactly(tmp_path, suffix):
    curve = gallery.curve("pretzel")
    assert np.array_equal(read_curve(write_curve(tmp_path / f"curve{suffix}", curve)).points, curve.points)


@pytest.mark.filterwarnings("ignore::tween.errors.NotUsedWarning")
@pytest.mark.parametrize("suffix", [".svg", ".obj", ".json", ".npz"])
def test_a_triangulation_is_written_exactly(tmp_path, suffix):
    T = triangulate(gallery.curve("horseshoe"))
    path = write_triangulation(tmp_path / f"disk{suffix}", T)
    if suffix == ".svg":
        assert np.array_equal(read_curve(path, select="curve").points, T.points)
        assert len(read_curves(path)) == 1 + len(T.triangles)
        return
    if suffix == ".obj":
        rows = [line.split() for line in path.read_text().splitlines()]
        points = np.array([row[1:3] for row in rows if row[0] == "v"], dtype=float)
        triangles = np.array([row[1:] for row in rows if row[0] == "f"], dtype=int) - 1
        assert {row[3] for row in rows if row[0] == "v"} == {"0"}
    else:
        content = json.loads(path.read_text()) if suffix == ".json" else np.load(path)
        points, triangles = np.array(content["points"]), np.array(content["triangles"])
        assert np.array_equal(read_curve(path).points, T.points)
    assert np.array_equal(points, T.points)
    assert np.array_equal(triangles, T.triangles)
