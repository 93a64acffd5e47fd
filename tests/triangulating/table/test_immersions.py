"""All immersed disks of a curve: one all-Delaunay triangulation for each class of triangulations that flips join."""

import numpy as np
import oracle
import pytest
from strategies import random_polygons

from tween import gallery
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import flip, flippable, locally_delaunay
from tween.triangulating.table.splits import Table


def classes(points):
    """Classes of triangulations that flips lead to, from one to the next."""
    left, found = {oracle.as_set(T) for T in oracle.valid_triangulations(points)}, []
    d = decompose(points)
    while left:
        start = next(T for T in (d.sample(np.random.default_rng(k)) for k in range(10**6)) if key(T) in left)
        reached, waiting = {key(start)}, [start]
        while waiting:
            T = waiting.pop()
            for diagonal, turns in zip(T.diagonals.tolist(), flippable(T), strict=True):
                after = flip(T, tuple(diagonal)) if turns else None
                if after is not None and key(after) not in reached:
                    reached.add(key(after))
                    waiting.append(after)
        left -= reached
        found.append(reached)
    return found


def key(T):
    return oracle.as_set(T.triangles.tolist())


@pytest.mark.parametrize("kind", ["disk", "strip", "grid"])
def test_there_is_one_for_each_class_of_triangulations_that_flips_join(kind):
    tried = 0
    for points in random_polygons(kind, 30, seed=5):
        d = decompose(points)
        if d:
            found = [key(T) for T in d.immersions()]
            every = classes(d.curves[0].points)
            assert len(found) == len(every)
            assert all(sum(T in reached for T in found) == 1 for reached in every)
            tried += 1
    assert tried >= 5


@pytest.mark.parametrize("name", ["two_disks", "five_disks"])
def test_of_curves_that_bound_several_all_are_delaunay_and_differ(name):
    curve = gallery.curve(name)
    found = decompose(curve).immersions()
    assert len(found) == {"two_disks": 2, "five_disks": 5}[name]
    assert all(locally_delaunay(T).all() for T in found)
    assert len({key(T) for T in found}) == len(found)


def test_the_reduced_curve_and_the_whole_table_list_the_same_disks():
    curve = gallery.curve("five_disks").insert_vertices(201)  # is reduced first
    found = decompose(curve).immersions()
    whole = Table(curve.points[None]).delaunay()
    assert len(found) == len(whole) == 5


def test_cocircular_vertices_make_no_disk_twice():
    square = [[x, y] for x, y in ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))]
    assert len(Table(np.array(square, dtype=float)[None]).delaunay()) == 1
