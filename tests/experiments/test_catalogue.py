"""The catalogue: every step is a module, every file of results/ has one step that writes it."""

import ast
import importlib.util
import json

import pytest

from experiments import catalogue
from experiments.store import FIGURES, RESULTS, ROOT

STUDIES = (*catalogue.STUDIES, catalogue.MATCHING, catalogue.GRID)
KINDS = ("csv", "json", "md", "tex")
steps = pytest.mark.parametrize("step", catalogue.EVERY, ids=lambda step: step.module)


@steps
def test_a_step_is_a_module(step: catalogue.Step) -> None:
    assert importlib.util.find_spec(f"experiments.{step.module}")


def test_every_study_has_a_module_and_every_module_of_a_study_stands_here() -> None:
    modules = {f"studies.{path.stem}" for path in (ROOT / "experiments" / "studies").glob("[!_]*.py")}
    assert [step.module for step in STUDIES if step.module not in modules] == []
    assert modules == {step.module for step in STUDIES}


def test_every_result_has_one_step_that_writes_it() -> None:
    written = [file for step in catalogue.EVERY for file in step.results]
    assert len(written) == len(set(written))
    there = {path.relative_to(RESULTS).as_posix() for suffix in KINDS for path in RESULTS.rglob(f"*.{suffix}")}
    assert there == set(written) - {"report.html", "article.pdf"}


@pytest.mark.parametrize("step", STUDIES, ids=lambda step: step.module)
def test_a_study_names_the_files_that_it_writes(step: catalogue.Step) -> None:
    source = (ROOT / "experiments" / "studies" / f"{step.name}.py").read_text(encoding="utf-8")
    words = {node.value for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Constant)}
    assert set(step.results) <= words


def test_every_figure_about_a_study_is_drawn() -> None:
    captions = json.loads((FIGURES / "captions.json").read_text(encoding="utf-8"))
    assert {figure for step in catalogue.EVERY for figure in step.figures} <= set(captions)


def test_the_writer_of_a_file_is_told_with_its_command() -> None:
    assert catalogue.writer("roots.csv").command == "python -m experiments.studies.roots"
