"""The grid of Table 1: complete, what the code gives, and nothing in it that rounding decides."""

import numpy as np
import pandas as pd
import pytest

from experiments import family
from experiments.measures import certain_ranks, shortening, slid
from experiments.store import RESULTS
from experiments.studies import grid, grid_sample
from tween import triangulate

DISK, PAIRS, SHAPES = (pd.read_csv(RESULTS / f"grid_{name}.csv") for name in ("disk", "pairs", "shapes"))


@pytest.mark.parametrize("part", ["blob 0 @24", "star 5 0.5 over @24", "letter e @24"])
def test_the_committed_rows_of_a_part_are_what_the_code_gives(part: str) -> None:
    found = grid.tables([grid.work(part)])
    for name, table in found.items():
        assert name == "pairs" or len(table)
        assert grid_sample.differences(name, table, pd.read_csv(RESULTS / f"grid_{name}.csv")) == []


def test_a_pair_that_cannot_have_so_few_vertices_has_no_rows() -> None:
    assert grid.work("row 3 @24") == {"pairs": []}
    assert not ((PAIRS.row == 3) & (PAIRS.n == 24)).any()


def test_every_curve_has_every_setting() -> None:
    assert list(DISK.curve.unique()) == list(SHAPES.curve.unique()) == list(family.names())
    settings = DISK.groupby(["curve", "n", "path", "pace"]).frames.apply(lambda frames: sorted(set(frames)))
    at = settings.index.get_level_values("n") == grid.PARAMETERS["n"]
    assert (settings[at].map(len) == len(grid.PARAMETERS["frames"])).all()
    assert (settings[~at].map(tuple) == (grid.PARAMETERS["default_frames"],)).all()
    assert len(settings) == len(family.names()) * len(grid.PARAMETERS["sizes"]) * 4


def test_ranks_grow_as_the_tolerance_falls() -> None:
    for table in (DISK, PAIRS):
        ranks = table[[f"AR_{rtol}" for rtol in grid.TOLERANCES]].astype(float)
        assert (ranks.ffill(axis=1).diff(axis=1).iloc[:, 1:] >= 0).all(axis=None)


def test_common_triangulations_are_never_flipped_and_zigzags_are_compatible() -> None:
    assert (PAIRS[PAIRS.triangulation.str.startswith("common")].flips == 0).all()
    remeshed = PAIRS[PAIRS.triangulation == "remeshed"].groupby(["row", "n"]).flips.first()
    assert (remeshed[[1, 3]].drop(192, level="n") == 0).all() and (remeshed[[4, 7]] > 0).all()


def test_a_rank_is_certain_where_no_singular_value_lies_at_the_tolerance() -> None:
    rng = np.random.default_rng(0)
    U, V = (np.linalg.qr(rng.normal(size=(20, 5)))[0] for _ in range(2))
    least, most = certain_ranks(U @ np.diag([1, 0.5, 1e-3, 1e-8, 1e-12]) @ V.T, [1e-4, 1e-10, 1e-12])
    assert least[:2] == most[:2] == [3, 4]
    assert (least[2], most[2]) == (4, 5)


def test_perturbed_areas_have_a_rank_that_was_foreseen() -> None:
    A = np.vander(np.linspace(0.5, 1, 40), 30)
    for seed in range(5):
        least, most = certain_ranks(A, [1e-6, 1e-9])
        B = A * (1 + 1e-12 * np.random.default_rng(seed).uniform(-1, 1, A.shape))
        found = [int((s := np.linalg.svd(B, compute_uv=False), (s > rtol * s[0]).sum())[1]) for rtol in (1e-6, 1e-9)]
        assert all(a <= r <= b for a, r, b in zip(least, found, most, strict=False))


def test_deep_slides_are_slides() -> None:
    T = triangulate(family.at("letter e", 96))
    disk = T.on_disk().points
    slides, deep = slid(T, disk).any(axis=1), shortening(T, disk) > grid.DEEP
    assert 0 < deep.sum() < slides.sum()
    assert not (deep & ~slides).any()


def test_the_unit_of_area_moves_no_rank() -> None:
    A = np.vander(np.linspace(0.5, 1, 40), 30)
    ranks = [certain_ranks(factor * A, [float(rtol) for rtol in grid.TOLERANCES[:8]])[0][:8] for factor in (1, 2.0**20)]
    assert ranks[0] == ranks[1]
