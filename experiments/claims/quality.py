"""Section 7: whether AR and Var measure what is meant by a smooth, uniform, good morph."""

from collections.abc import Iterator

import pandas as pd

from experiments.claims.ledger import Finding, Numbers, claim
from experiments.claims.rules import Cases, tracks_pairs
from experiments.studies.quality import within_pairs

SMOOTH = {"path_length": "length of paths", "swelling": "swelling", "invalid": "frames without a disk"}
FRAMES = 61
VALID = "among morphs all of whose frames bound immersed disks, as the paper's do; judged by paths and swelling"
CASE = (
    "a pair of curves; over the methods of results/matching.csv, which lead from one to the other in different ways, "
    "the measure goes with the length of the vertices' paths, with swelling, and with the number of frames that bound "
    "no disk"
)
EVIDENCE = ("experiments/studies/quality.py", "experiments/studies/matching.py")


def correlations(rows: pd.DataFrame, measure: str) -> Iterator[Cases]:
    """What the measure goes with, over the methods of one pair; where all frames bound disks only the other two."""
    for quality, word in SMOOTH.items():
        found = within_pairs(rows, measure, quality)
        if len(found):
            yield tracks_pairs(found, word)


def finding(x: Numbers, measure: str) -> Finding:
    """Over all methods, and over those all of whose frames bound disks."""
    rows = x.table("matching")
    valid = rows[rows.disks == FRAMES]
    return Finding(told(x, measure), tuple(correlations(rows, measure)), tuple(correlations(valid, measure)))


def told(x: Numbers, measure: str) -> str:
    """The same over random triangulations of one curve, and for the methods that break the disk and are rated best."""
    table = x.table("quality").query("scope == 'triangulations of one curve' and measure == @measure")
    rho = table.set_index("quality").rho
    words = ", ".join(f"{word} {rho[quality]:.2f}" for quality, word in SMOOTH.items() if quality in rho)
    rows = x.table("matching").set_index("method")
    straight, matched = rows.loc["straight"], rows.loc["matched"]
    return (
        f"over random triangulations of one curve, medians: energy {rho['energy']:.2f}, {words}. Straight lines, "
        f"which leave the immersed disks on {(straight.disks < FRAMES).sum()} of {len(straight)} pairs, have a median "
        f"{measure} of {straight[measure].median():.2g}, matched morphs, which never do, "
        f"{matched[measure].median():.2g}"
    )


@claim(
    "7",
    '"Second, we have observed that if in different geometric parameters (like area), the different triangles vary '
    'uniformly throughout the morph sequence, then we get a smooth morph." "The rank of this matrix gives us a measure '
    'of the uniformity of areas of different triangles over different morph frames."',
    "tracks",
    f"AR at 1e-4; {CASE}",
    EVIDENCE,
    figure="quality.png",
    condition=VALID,
)
def rank_tracks_smoothness(x: Numbers) -> Finding:
    return finding(x, "AR_1e-4")


@claim(
    "7",
    '"For a uniform morph, we can expect this magnitude to be the same between any two adjacent frames. Variance in '
    'this magnitude should be minimum for a smooth morph."',
    "tracks",
    f"Var; {CASE}",
    EVIDENCE,
    figure="quality.png",
    condition=VALID,
)
def variance_tracks_smoothness(x: Numbers) -> Finding:
    return finding(x, "Var")
