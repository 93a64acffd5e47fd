"""The study of roots: its bounds on the rank against rational arithmetic, and its rows against the code."""

from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

from experiments.studies import roots
from tween import Triangulation, remesh
from tween.gallery.generators import random_disk
from tween.geometry.dual_tree import disk_center, hops, rooted


def rational_areas(T: Triangulation, disk: Triangulation, root: int, t: int) -> list[Fraction]:
    """Twice the areas along "linear", the root's base being kept from 0 to 1."""
    tree = rooted(T, root)
    points = [[(Fraction(x), Fraction(y)) for x, y in S.points.tolist()] for S in (T, disk)]
    place: dict[int, tuple[Fraction, Fraction]] = {}
    for node in tree.order.tolist():
        a, b, c = (int(T.triangles[node, (tree.base[node] + s) % 3]) for s in range(3))
        if node == root:
            place |= {a: (Fraction(0), Fraction(0)), b: (Fraction(1), Fraction(0))}
        z = [third(*(p[v] for v in (a, b, c))) for p in points]
        x, y = ((1 - t) * z[0][i] + t * z[1][i] for i in (0, 1))
        (ax, ay), (bx, by) = place[a], place[b]
        place[c] = ax + x * (bx - ax) - y * (by - ay), ay + x * (by - ay) + y * (bx - ax)
    corners = [[place[int(v)] for v in triangle] for triangle in T.triangles]
    return [(b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) for a, b, c in corners]


def third(
    a: tuple[Fraction, Fraction], b: tuple[Fraction, Fraction], c: tuple[Fraction, Fraction]
) -> tuple[Fraction, Fraction]:
    u, v, p, q = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    return (p * u + q * v) / (u * u + v * v), (q * u - p * v) / (u * u + v * v)


@pytest.mark.parametrize("n", [4, 5, 9, 16])
def test_areas_modulo_the_prime_are_those_of_rational_arithmetic(n: int) -> None:
    T, times = random_disk(n, np.random.default_rng(n)), np.array([1, 2, 5])
    for root in range(len(T.triangles)):
        found = roots.areas_modulo(T, T.on_disk(), root, times).T.tolist()
        for t, areas in zip(times.tolist(), found, strict=True):
            exact = rational_areas(T, T.on_disk(), root, t)
            assert areas == [x.numerator * pow(x.denominator, -1, roots.PRIME) % roots.PRIME for x in exact]


def test_elimination_modulo_the_prime_finds_the_rank() -> None:
    rng = np.random.default_rng(0)
    for rank in range(6):
        A = rng.integers(0, 9, (6, rank)) @ rng.integers(0, 9, (rank, 8))
        assert roots.rank_modulo(A) == np.linalg.matrix_rank(A.astype(float))


@pytest.mark.parametrize("n", [4, 9, 20, 40])
def test_the_bounds_hold_in_their_order(n: int) -> None:
    T = random_disk(n, np.random.default_rng(n))
    for root in range(0, len(T.triangles), 3):
        by_height, by_cut = roots.rank_bounds(T, root)
        assert roots.exact_rank(T, T.on_disk(), root) <= by_cut <= by_height <= 2 * hops(T, root).max() + 2


def test_a_fan_hung_from_its_end_has_only_the_bound_of_its_size() -> None:
    n = 9
    T = Triangulation(
        random_disk(n, np.random.default_rng(0)).on_disk().points, [[0, i, i + 1] for i in range(1, n - 1)]
    )
    assert roots.rank_bounds(T, 0) == (n - 2, n - 2)


def test_the_triangle_closest_to_the_centre_halves_the_curve() -> None:
    for seed in range(5):
        T = remesh(random_disk(30, np.random.default_rng(seed)))
        sides = roots.larger_side(T)
        centre = disk_center(T, T.on_disk())
        assert sides[centre] == sides.min() <= 0.5
        assert roots.distance_from_centre(T, T.on_disk())[centre] == 0


def test_an_excursion_is_measured_from_the_segment() -> None:
    frames = np.array([[[0.0, 0.0]], [[1.0, 3.0]], [[6.0, 0.0]], [[2.0, 0.0]]])
    assert roots.excursion(frames) == 4.0
    assert roots.excursion(frames[:, :, ::-1]) == 4.0
    assert roots.excursion(frames[[0, 1, 0]]) == pytest.approx(np.hypot(1, 3))


@pytest.mark.parametrize(("name", "root"), [("ell", 3), ("comb", 17), ("letter c", 40)])
def test_the_committed_rows_are_what_the_code_gives(name: str, root: int) -> None:
    table = pd.read_csv(roots.RESULTS / "roots.csv").set_index(["curve", "root"])
    T = roots.subject(name)
    row, about = table.loc[(name, root)], roots.properties(T, T.on_disk()).loc[root]
    assert row["height"] == about["height"]
    assert row["stretch"] == pytest.approx(about["stretch"], rel=1e-2)
    for path in roots.PARAMETERS["paths"]:
        found = roots.measure(T, T.on_disk(), path, root)
        assert row[f"AR_1e-4 {path}"] == found["AR_1e-4"]
        for measure in ("Var", "Var_scaled", "excursion", "excursion_scaled", "area_max"):
            assert row[f"{measure} {path}"] == pytest.approx(found[measure], rel=1e-2)


def test_the_committed_table_is_complete() -> None:
    table = pd.read_csv(roots.RESULTS / "roots.csv", keep_default_na=False)
    assert list(dict.fromkeys(table["curve"])) == list(roots.shapes())
    assert table["root"].tolist() == table.groupby("curve", sort=False).cumcount().tolist()
    for rule in roots.RULES:
        assert table["rules"].str.split("; ").map(lambda rules, rule=rule: rule in rules).sum() == 34
