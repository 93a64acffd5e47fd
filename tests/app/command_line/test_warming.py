"""The tasks of `tween warmup` use every kernel there is."""

import ast
import subprocess
import sys
from pathlib import Path

import numba
import pytest
from terminal import Run

import tween
from tween.app.command_line import warming

PACKAGE = Path(tween.__file__).parent
# Runs all tasks in a process of its own, and prints the kernels that were called from Python, and not by kernels only.
CALLED = """
import sys
from numba.core.dispatcher import Dispatcher
from tween.app.command_line.warming import TASKS, run

for name in TASKS:
    run(name)
for module in [module for name, module in sys.modules.items() if name.startswith("tween.")]:
    for name, value in vars(module).items():
        if isinstance(value, Dispatcher) and value.py_func.__module__ == module.__name__ and value.signatures:
            print(module.__name__, name)
"""


def is_kernel(node: ast.AST) -> bool:
    return isinstance(node, ast.FunctionDef) and any("njit" in ast.unparse(d) for d in node.decorator_list)


def module_of(path: Path) -> str:
    return ".".join(["tween", *path.relative_to(PACKAGE).with_suffix("").parts])


def names_in_python(tree: ast.Module) -> set[str]:
    """The names that something else than a kernel uses."""
    rest = [node for node in tree.body if not is_kernel(node)]
    return {name.id for node in rest for name in ast.walk(node) if isinstance(name, ast.Name)}


def kernels_used_by_python() -> set[str]:
    """Module and name of each kernel that something else than a kernel uses."""
    trees = {module_of(path): ast.parse(path.read_text()) for path in PACKAGE.rglob("*.py")}
    used = {(module, name) for module, tree in trees.items() for name in names_in_python(tree)}
    for tree in trees.values():
        names = names_in_python(tree)
        imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        used |= {(node.module or "", alias.name) for node in imports for alias in node.names if alias.name in names}
    kernels = {(module, node.name) for module, tree in trees.items() for node in tree.body if is_kernel(node)}
    return {" ".join(kernel) for kernel in kernels & used}


@pytest.mark.slow
@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
def test_every_kernel_is_compiled_by_one_of_the_tasks() -> None:
    done = subprocess.run([sys.executable, "-c", CALLED], capture_output=True, text=True, check=True)
    # the signs without rounding are native functions, compiled with all that they use when their module is imported
    expected = {name for name in kernels_used_by_python() if not name.startswith("tween.geometry.expansions ")}
    assert len(expected) > 30
    assert expected - set(done.stdout.splitlines()) == set()


def test_tasks_run_in_other_processes_and_an_error_of_one_is_an_error_of_all(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(warming, "TASKS", {"draw": warming.TASKS["draw"]})
    status, out, _ = run("warmup --jobs 1")
    assert status == 0
    assert out.startswith("kernels are compiled, in ")
    monkeypatch.setattr(warming, "TASKS", {"no such task": None})
    with pytest.raises(KeyError, match="no such task"):
        run("warmup --jobs 1")
