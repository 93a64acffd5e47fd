"""The project keeps its own rules: imports, traces of a machine, documentation, commands."""

import ast
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MODULES = sorted(path for path in (ROOT / "tween").glob("**/*.py") if path.name != "__init__.py")

# Each module imports only from layers above its own line here.
LAYERS = (
    {"errors"},
    {"predicates"},
    {"curve"},
    {"triangulation"},
    {"flips", "dual", "table", "paths", "budgets", "costs"},
    {"bounds", "reduction", "splits"},
    {"decomposition", "sequence", "compatible", "generators"},
    {"gradual"},
    {"align"},
    {"motion"},
    {"morph"},
    {"metrics", "certificate", "baselines"},
    {"handwriting", "files", "svgpath"},
    {"gallery"},
    {"svg", "readers", "writers"},
    {"io"},
    {"named", "plot", "stroke"},
    {"film", "pictures", "footage"},
    {"raster", "animate_svg"},
    {"animate"},
    {"sketch"},
    {"widget", "options", "commands"},
    {"cli"},
    {"__main__"},
)
# What imports matplotlib: figures of shapes, figures of numbers, and the colours of films.
DRAWING = {"plot", "pictures", "film"}
# Imports (from, of) between modules of one layer; each needs its reason.
SAME_LAYER: frozenset[tuple[str, str]] = frozenset()
LAYER = {module: depth for depth, layer in enumerate(LAYERS) for module in layer}


def name_of(path: Path) -> str:
    """Return the path as the repository spells it."""
    return path.relative_to(ROOT).as_posix()


# Imports


def imported(tree: ast.AST) -> Iterator[str]:
    """Yield the dotted name of every module that the source imports, wherever the import stands."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = ".".join(filter(None, ["tween" if node.level else "", node.module]))
            yield from (f"{package}.{alias.name}" if package == "tween" else package for alias in node.names)


def import_faults(module: str, source: str, allowed: frozenset[tuple[str, str]] = SAME_LAYER) -> list[str]:
    """Name each import that breaks the order of the layers."""
    if module not in LAYER:
        return [f"{module} has no layer: give it one in LAYERS"]
    faults = []
    for name in imported(ast.parse(source)):
        root, *rest = name.split(".")
        if root == "matplotlib" and module not in DRAWING:
            faults.append(f"{module} imports {name}: only {' and '.join(sorted(DRAWING))} draw")
        if root != "tween" or (module, *rest[:1]) in allowed:
            continue
        if not rest or rest[0] not in LAYER:
            faults.append(f"{module} imports {name}, which is no module: import from the module that defines it")
        elif LAYER[rest[0]] >= LAYER[module]:
            faults.append(f"{module} imports {rest[0]}, which is not below it")
    return faults


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_run_one_way(path: Path) -> None:
    assert import_faults(path.stem, path.read_text()) == []


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("curve", "from tween.triangulation import Triangulation"),
        ("curve", "import tween.morph as m"),
        ("curve", "from tween import morph"),
        ("curve", "from tween import Curve"),
        ("curve", "from . import morph"),
        ("curve", "from .morph import Morph"),
        ("curve", "def late():\n    from tween.plot import draw"),
        ("flips", "from tween.dual import DualTree"),
        ("gallery", "from matplotlib import pyplot"),
        ("surprise", ""),
    ],
)
def test_an_upward_import_is_seen(module: str, source: str) -> None:
    assert len(import_faults(module, source)) == 1


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("morph", "from tween.curve import Curve\nfrom tween.errors import TweenError"),
        ("morph", "from . import paths\nfrom .dual import DualTree"),
        ("plot", "import matplotlib.pyplot as plt\nfrom tween.gallery import figure"),
    ],
)
def test_a_downward_import_is_fine(module: str, source: str) -> None:
    assert import_faults(module, source) == []


def test_an_import_within_a_layer_needs_an_allowance() -> None:
    source = "from tween.dual import DualTree"
    assert import_faults("flips", source) == ["flips imports dual, which is not below it"]
    assert import_faults("flips", source, frozenset({("flips", "dual")})) == []


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
