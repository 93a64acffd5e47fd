"""Every study once: its question, what it writes, which figures show it, and how long it takes.

`reproduce` begins the longest first, but none before those are done whose results it reads; the report, the
ledger of claims, the documentation and the tests look up here what a step is called, and which one writes a file.
"""

from typing import NamedTuple


class Step(NamedTuple):
    """A module of this package that computes something: ``python -m experiments.<module>``."""

    module: str
    title: str
    results: tuple[str, ...] = ()  # in results/, the one that sums it up first
    figures: tuple[str, ...] = ()  # in results/figures/, those about this step alone
    seconds: int = 0  # roughly, on two cores of which another step has one
    after: tuple[str, ...] = ()  # modules of the steps whose results it reads

    @property
    def name(self) -> str:
        """The last part of the module's name."""
        return self.module.rpartition(".")[2]

    @property
    def command(self) -> str:
        return f"python -m experiments.{self.module}"


STUDIES = (
    Step(
        "studies.to_disk",
        "Table 1: every curve to its disk",
        results=("table_1_to_disk.csv", "table_1_to_disk.json", "table_1_paper.csv"),
        figures=("table_1_slide", "table_1_linear", "table_1_slide_all", "table_1_linear_all"),
        seconds=100,
    ),
    Step(
        "studies.curve_to_curve",
        "Table 1: the paper's four columns",
        results=(
            "table_1_curve_to_curve.csv",
            "table_1_curve_to_curve_ways.csv",
            "table_1_curve_to_curve_flips.csv",
        ),
        figures=("table_1_curve_to_curve",),
        seconds=60,
    ),
    Step(
        "studies.sensitivity",
        "Table 1: what the verdict depends on",
        results=("sensitivity.csv", "table_1_slides.csv"),
        figures=("sensitivity", "table_1_slides"),
        seconds=80,
    ),
    Step(
        "studies.table_1_layout",
        "Table 1: in the paper's layout",
        results=("table_1.csv", "table_1.md", "table_1.tex"),
        seconds=5,
        after=("studies.to_disk", "studies.curve_to_curve"),
    ),
    Step("studies.grid_sample", "Table 1: a sample of the grid again", seconds=20),
    Step(
        "studies.grid_law",
        "Table 1: what predicts the factor",
        results=("grid_law.csv", "grid_columns.csv", "grid_cells.csv"),
        figures=("table_1_factor", "table_1_law", "table_1_columns"),
        seconds=15,
    ),
    Step("studies.pairs", "Every pair of curves", results=("pairs.csv",), seconds=120),
    Step("studies.pivots", "Pivots matched or not", results=("pivots.csv",), seconds=45),
    Step(
        "studies.flip_distance",
        "Flip sequences and the flip distance",
        results=("flip_distance.csv",),
        seconds=10,
    ),
    Step(
        "studies.flip_order",
        "An order of flips that finishes early",
        results=("flip_order_summary.csv", "flip_order.csv"),
        seconds=35,
    ),
    Step(
        "studies.roots",
        "The triangle that the motion starts from",
        results=("roots_summary.csv", "roots.csv"),
        figures=("root_shapes", "root_choice", "root_choice_all", "root_heights"),
        seconds=65,
    ),
    Step(
        "studies.root_steady",
        "The root, where it no longer decides the size",
        results=("root_steady_summary.csv", "root_steady.csv"),
        seconds=30,
    ),
    Step(
        "studies.guarantee",
        "Frames that bound a disk",
        results=("guarantee_summary.csv", "guarantee.csv"),
        figures=("guarantee_fan", "guarantee_study", "guarantee_paths"),
        seconds=140,
    ),
    Step(
        "studies.quality",
        "Does the paper's measure measure quality?",
        results=("quality.csv", "quality_search.csv"),
        figures=("quality",),
        seconds=75,
    ),
    Step("studies.matching_sample", "Matching: a sample of all pairs again", seconds=20),
)
# All pairs take long, so `make matching` computes them, and `reproduce` a sample only, which it compares.
MATCHING = Step(
    "studies.matching",
    "Matching: all pairs, every method",
    results=("matching_summary.csv", "matching.csv"),
    figures=("matching_study", "matching_pairs"),
    seconds=600,
)
# The same holds for the grid of Table 1 and `make grid`.
GRID = Step(
    "studies.grid",
    "Table 1: the grid",
    results=("grid_disk.csv", "grid_pairs.csv", "grid_shapes.csv"),
    seconds=400,
)
_STUDIED = tuple(step.module for step in STUDIES)
_MADE = ("claims", "figures", "figures.animations")
# What is made of the studies' results.
STEPS = (
    *STUDIES,
    Step(
        "claims",
        "The verdict on every claim",
        results=("claims.csv",),
        figures=("verdicts",),
        seconds=30,
        after=_STUDIED,
    ),
    Step(
        "figures",
        "Figures",
        results=("figures/captions.json", "figures/drawn.json"),
        seconds=60,
        after=(*_STUDIED, "claims"),
    ),
    Step("figures.animations", "Animations", seconds=30),
    Step("notebooks", "Notebooks", seconds=60, after=_MADE),
    Step("article", "The article", results=("article.pdf",), seconds=5, after=_MADE),
    Step("report", "The report", results=("report.html",), seconds=10, after=(*_MADE, "notebooks", "article")),
)
# Times that it measures are no results that could be found again, so `reproduce` leaves it out.
SCALING = Step("benchmarks.scaling", "How the time grows", results=("scaling.csv",), figures=("scaling",), seconds=60)
EVERY = (*STEPS, MATCHING, GRID, SCALING)


def writer(file: str) -> Step:
    """The step that writes a file of results/."""
    return next(step for step in EVERY if file in step.results)
