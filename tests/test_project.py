"""The project keeps its own rules: imports, tests, traces of a machine, documentation, commands."""

import ast
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MODULES = sorted((ROOT / "tween").glob("**/*.py"))
# Test files in a folder of the package that test something else than a module.
WITHOUT_MODULE = {
    "app/playground/test_browser.py": "the face of the playground, in a browser",
    "morphing/matching/test_lift.py": "that refinement is no worse than a lift of the first level",
    "morphing/test_guarantee.py": "what a guarantee promises, along all paths and strategies",
}
# Modules that serve another one, and are tested with it.
TESTED_WITH = {
    "measuring/played.py": "measuring/test_certificate.py",
    "measuring/refinement.py": "measuring/test_certificate.py",
    "morphing/keyframes/legs.py": "morphing/test_sequence.py",
    "morphing/motion.py": "morphing/test_motions.py",
    "morphing/plan.py": "measuring/test_promise.py",
    "morphing/incompatible/clock.py": "morphing/incompatible/test_flow.py",
    "morphing/incompatible/through.py": "morphing/incompatible/test_flow.py",
}


def name_of(path: Path) -> str:
    """Return the path as the repository spells it."""
    return path.relative_to(ROOT).as_posix()


# Imports


def lint_imports(folder: Path) -> "subprocess.CompletedProcess[str]":
    """Check the contracts of pyproject.toml in a folder, whatever is installed or on the path of this process."""
    code = "import sys, importlinter.cli as c; sys.exit(c.lint_imports(no_cache=True, no_logo=True))"
    env = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return subprocess.run([sys.executable, "-c", code], cwd=folder, env=env, capture_output=True, text=True)


def test_imports_keep_the_contracts() -> None:
    done = lint_imports(ROOT)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("path", "line", "contract"),
    [
        ("geometry/curve.py", "from tween.triangulating.flips import remesh", "Folders import what lies below them"),
        ("geometry/curve.py", "import tween.plot.film as f", "Folders import what lies below them"),
        ("geometry/curve.py", "from ..io import svg", "Folders import what lies below them"),
        ("io/formats/svg.py", "def late():\n    from tween.plot import shapes", "Folders import what lies below them"),
        ("gallery/curves.py", "import tween.measuring.metrics", "Folders import what lies below them"),
        ("surprise.py", "", "Folders import what lies below them"),
        ("gallery/curves.py", "import tween.triangulating.flips", "The gallery makes its curves"),
        ("morphing/compatible/leg.py", "import tween.morphing.alignment", "Within morphing"),
        ("geometry/curve.py", "from tween import Triangulation", "A name is imported from the module"),
        ("geometry/curve.py", "from .. import Triangulation", "A name is imported from the module"),
        ("geometry/predicates.py", "from tween.geometry.curve import Curve", "No circles"),
        ("io/formats/svg.py", "from experiments import store", "The library knows nothing of its studies"),
        ("app/command_line/main.py", "from matplotlib import pyplot", "Only plot imports matplotlib"),
    ],
)
def test_an_import_that_breaks_a_contract_is_seen(path: str, line: str, contract: str, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "tween", tmp_path / "tween", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    with open(tmp_path / "tween" / path, "a") as file:
        file.write(f"\n{line}\n")
    done = lint_imports(tmp_path)
    said = " ".join(done.stdout.split())
    assert done.returncode == 1, said
    assert re.search(rf"{contract}[^.]*? ?BROKEN", said), said


# Tests


def mirror_faults(modules: set[str], tests: set[str]) -> list[str]:
    """Name each module without a test file of its name in the same folder, and each such file without a module.

    Files directly in tests/ may test the project as a whole; those in other folders than the package's, others.
    """
    folders = {module.partition("/")[0] for module in modules if "/" in module}
    wanted = {re.sub(r"(\w+)\.py$", r"test_\1.py", module) for module in modules}
    mirrored = {test for test in tests if test.partition("/")[0] in folders}
    faults = [f"tests/{test} is missing" for test in sorted(wanted - tests)]
    return faults + [f"tests/{test} tests no module" for test in sorted(mirrored - wanted)]


def test_every_module_has_its_test_file_and_every_test_file_its_module() -> None:
    modules = {path.relative_to(ROOT / "tween").as_posix() for path in MODULES if path.name != "__init__.py"}
    tests = {path.relative_to(ROOT / "tests").as_posix() for path in (ROOT / "tests").glob("**/test_*.py")}
    assert len(modules) > 40
    assert TESTED_WITH.keys() <= modules
    assert set(TESTED_WITH.values()) <= tests
    assert mirror_faults(modules - TESTED_WITH.keys(), tests - WITHOUT_MODULE.keys()) == []
    assert WITHOUT_MODULE.keys() <= tests


@pytest.mark.parametrize(
    ("modules", "tests", "faults"),
    [
        ({"a.py", "b/c.py"}, {"test_a.py", "b/test_c.py", "test_whole.py", "studies/test_s.py"}, []),
        ({"a.py", "b/c.py"}, {"test_a.py"}, ["tests/b/test_c.py is missing"]),
        ({"b/c.py"}, {"b/test_c.py", "b/test_d.py"}, ["tests/b/test_d.py tests no module"]),
        ({"b/c.py"}, {"test_c.py"}, ["tests/b/test_c.py is missing"]),
        ({"b/c/d.py"}, {"b/test_d.py"}, ["tests/b/c/test_d.py is missing", "tests/b/test_d.py tests no module"]),
    ],
)
def test_a_missing_or_stray_test_file_is_seen(modules: set[str], tests: set[str], faults: list[str]) -> None:
    assert mirror_faults(modules, tests) == faults


@pytest.mark.parametrize("path", sorted((ROOT / "tests").glob("**/test_*.py")), ids=name_of)
def test_a_test_file_says_what_it_tests_and_tests_it(path: Path) -> None:
    tree = ast.parse(path.read_text())
    assert ast.get_docstring(tree)
    assert any(isinstance(n, ast.FunctionDef) and n.name.startswith("test_") for n in tree.body)


# Traces of a machine

# Written so that this file does not match itself.
TRACE = re.compile(
    r"(?<![\w.])/(?:work|root|home/\w+|Users/\w+|opt/\w+|tmp/bash)\b|pypi[.]org|pythonhosted[.]org|file:/{2}"
)


def trace_faults(name: str, text: str) -> list[str]:
    """Name each line that mentions a path or a host of the machine on which it was written."""
    return [f"{name}:{i}: {m[0]}" for i, line in enumerate(text.splitlines(), 1) if (m := TRACE.search(line))]


def tracked() -> list[Path]:
    """Return the files that git tracks and that still exist."""
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [path for name in listing.split("\0") if name and (path := ROOT / name).is_file()]


@pytest.mark.skipif(
    not (ROOT / ".git").exists(), reason="which files belong to the project is known in a git checkout only"
)
def test_no_file_mentions_the_machine_it_was_made_on() -> None:
    files = tracked()
    assert files
    assert [f for path in files for f in trace_faults(name_of(path), path.read_text(errors="replace"))] == []


@pytest.mark.parametrize("parts", [("", "work", "main"), ("see ", "root", ".cache"), ("https:", "", "pypi" + ".org")])
def test_a_trace_of_a_machine_is_seen(parts: tuple[str, ...]) -> None:
    assert len(trace_faults("file", "first line\n" + "/".join(parts))) == 1


@pytest.mark.parametrize("text", ["the work/rest ratio", "and/or/rooted", "results/work/a.csv", "../work/x"])
def test_a_relative_path_is_no_trace(text: str) -> None:
    assert trace_faults("file", text) == []


def test_the_lock_pins_every_package_and_says_nothing_else() -> None:
    lines = (ROOT / "requirements.lock").read_text().splitlines()
    pins = [line for line in lines if not line.startswith("#")]
    assert pins
    assert [line for line in pins if not re.fullmatch(r"[a-z0-9-]+==[0-9][\w.]*( ; .+)?", line)] == []


# Documentation


def is_kernel(node: ast.FunctionDef) -> bool:
    """Say whether numba compiles the function."""
    return any(re.match(r"(numba\.)?(njit|vectorize|guvectorize)\b", ast.unparse(d)) for d in node.decorator_list)


def parameters(node: ast.FunctionDef) -> list[ast.arg]:
    """Return the parameters of a function, self and cls left out."""
    a = node.args
    every = [*a.posonlyargs, *a.args, *([a.vararg] if a.vararg else []), *a.kwonlyargs, *([a.kwarg] if a.kwarg else [])]
    return [p for p in every if p.arg not in {"self", "cls"}]


def returns_something(node: ast.FunctionDef) -> bool:
    """Say whether a caller gets a value."""
    if node.returns is not None:
        return ast.unparse(node.returns) not in {"None", "NoReturn", "Never"}
    return any(isinstance(n, ast.Return | ast.Yield | ast.YieldFrom) and n.value is not None for n in ast.walk(node))


def function_faults(node: ast.FunctionDef) -> list[str]:
    """Name what a public function lacks; of a compiled kernel, which only modules call, a sentence is asked."""
    text = ast.get_docstring(node) or ""
    if not text:
        return [f"{node.name} has no docstring"]
    if is_kernel(node):
        return []
    faults = [f"{node.name} does not explain {p.arg}" for p in parameters(node) if not re.search(rf"\b{p.arg}\b", text)]
    if parameters(node) and "Parameters\n----------" not in text:
        faults.append(f"{node.name} has no section Parameters")
    if returns_something(node) and not re.search(r"^(Returns\n-------|Yields\n------)$", text, re.MULTILINE):
        faults.append(f"{node.name} has no section Returns")
    if node.returns is None or any(p.annotation is None for p in parameters(node)):
        faults.append(f"{node.name} has no annotations")
    return faults


def class_faults(node: ast.ClassDef) -> list[str]:
    """Name what the docstring of a public class lacks."""
    text = ast.get_docstring(node) or ""
    if not text:
        return [f"{node.name} has no docstring"]
    made_with = any(isinstance(n, ast.FunctionDef) and n.name == "__init__" and parameters(n) for n in node.body)
    fields = any(isinstance(n, ast.AnnAssign) for n in node.body)
    if "Made by `" in text:  # another function calls the constructor, and explains what it needs
        return []
    if (made_with or fields) and not re.search(
        r"^(Parameters\n----------|Attributes\n----------)$", text, re.MULTILINE
    ):
        return [f"{node.name} has no section Parameters or Attributes"]
    return []


def documentation_faults(source: str) -> list[str]:
    """Name what the public functions and classes of a module lack."""
    public = [n for n in ast.parse(source).body if not getattr(n, "name", "_").startswith("_")]
    faults = [f for n in public if isinstance(n, ast.FunctionDef) for f in function_faults(n)]
    return faults + [f for n in public if isinstance(n, ast.ClassDef) for f in class_faults(n)]


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_public_names_are_documented(path: Path) -> None:
    assert documentation_faults(path.read_text()) == []


DOCUMENTED = '''
def area(points: list) -> float:
    """Return the area.

    Parameters
    ----------
    points : list
        Corners.

    Returns
    -------
    float
        The area.
    """
'''


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("", "", []),
        ("def area(", "def _area(", []),
        ("Parameters\n", "Inputs\n", ["area has no section Parameters"]),
        ("Returns\n", "Gives\n", ["area has no section Returns"]),
        ("points: list)", "points)", ["area has no annotations"]),
        ("points: list)", "points: list, unit: str)", ["area does not explain unit"]),
        (DOCUMENTED, '@njit(cache=True)\ndef area(x):\n    """The area."""\n    return x', []),
        (DOCUMENTED, "def area(): ...", ["area has no docstring"]),
        (DOCUMENTED, "@njit\ndef area(): ...", ["area has no docstring"]),
        (DOCUMENTED, "class Area: ...", ["Area has no docstring"]),
        (DOCUMENTED, 'class Area:\n    """An area."""\n    x: int', ["Area has no section Parameters or Attributes"]),
        (DOCUMENTED, 'class Area:\n    """An area.\n\n    Made by `area`.\n    """\n    x: int', []),
    ],
)
def test_a_gap_in_the_documentation_is_seen(old: str, new: str, fault: list[str]) -> None:
    assert documentation_faults(DOCUMENTED.replace(old, new) if old else DOCUMENTED) == fault


# Commands


def test_help_lists_every_command() -> None:
    makefile = (ROOT / "Makefile").read_text()
    commands = {name for line in re.findall(r"^\.PHONY:(.*)$", makefile, re.MULTILINE) for name in line.split()}
    # A make that runs these tests hands its own flags down.
    env = {key: value for key, value in os.environ.items() if key not in {"MAKEFLAGS", "MFLAGS", "MAKELEVEL"}}
    listing = subprocess.run(["make"], cwd=ROOT, env=env, capture_output=True, text=True, check=True).stdout
    listed = {line.split()[1] for line in listing.splitlines() if line.startswith("  make ") and len(line.split()) > 2}
    assert {"setup", "reproduce", "test", "bench"} <= commands
    assert listed == commands
