"""Flip sequences beside the true flip distance, which is known for small polygons by search.

For every pair of triangulations of the n-gon, n = 4 to 9: crossings, length of the sequence of Section 6.2,
and the distance in the flip graph.  Writes results/flip_distance.csv.
"""

from collections import deque
from typing import Any

import numpy as np
import pandas as pd

from experiments.store import RESULTS, compute, write_csv
from experiments.subjects import flip_graph
from tween.morphing.incompatible.flip_sequence import count_crossings, flip_sequence

SIZES = [str(n) for n in range(4, 10)]


def distances(neighbours: list[list[int]], start: int) -> list[int]:
    reached, front = {start: 0}, deque([start])
    while front:
        here = front.popleft()
        for there in neighbours[here]:
            if there not in reached:
                reached[there] = reached[here] + 1
                front.append(there)
    return [reached[i] for i in range(len(neighbours))]


def work(size: str) -> dict[str, Any]:
    found, neighbours = flip_graph(int(size))
    # A rotation of both changes nothing: sources with the smallest key among their rotations stand for all.
    keys = [min(T.rolled(k).canonical.tobytes() for k in range(len(T))) for T in found]
    sources = [i for i, T in enumerate(found) if T.canonical.tobytes() == keys[i]]
    rows = []
    for i in sources:
        orbit = keys.count(keys[i])
        for j, distance in enumerate(distances(neighbours, i)):
            if i != j:
                S, T = found[i], found[j]
                rows.append((orbit, distance, len(flip_sequence(S, T)), count_crossings(S, T)))
    weight, true, length, crossings = np.array(rows, dtype=np.float64).T
    return {
        "n": int(size),
        "triangulations": len(found),
        "pairs": int(weight.sum()),
        "crossings_mean": np.average(crossings, weights=weight),
        "distance_mean": np.average(true, weights=weight),
        "sequence_mean": np.average(length, weights=weight),
        "shortest_share": np.average(length == true, weights=weight),
        "most_over": int((length - true).max()),
        "never_over_crossings": bool((length <= crossings).all()),
    }


def main() -> None:
    rows = compute("flip_distance", {"sizes": SIZES}, SIZES, work)
    write_csv(RESULTS / "flip_distance.csv", pd.DataFrame(rows).round(4))
    print("flip_distance: all pairs of triangulations of up to 9 vertices -> results/flip_distance.csv")


if __name__ == "__main__":
    main()
