"""The wheel: it holds all that the package needs, and works with the core dependencies alone."""

import os
import re
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterable
from importlib.metadata import distribution, packages_distributions
from pathlib import Path

import pytest

import tween

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
# Runs the command as if nothing else were installed than what was named before "--".
ALONE = """
import sys
from importlib.abc import MetaPathFinder

known = set(sys.argv[2 : sys.argv.index("--")]) | set(sys.stdlib_module_names)

class Missing(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in known:
            raise ModuleNotFoundError(f"no module named {name!r} in a plain installation", name=name)

sys.meta_path.insert(0, Missing())
entry = __import__("importlib.metadata").metadata.EntryPoint("tween", sys.argv[1], "console_scripts")
sys.exit(entry.load()(sys.argv[sys.argv.index("--") + 1 :]))
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel, and unpack it."""
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (path,) = folder.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder / "unpacked")
    return folder / "unpacked"


def core(requirements: Iterable[str]) -> set[str]:
    """Names of the distributions that a plain installation brings along."""
    found = set()
    for line in requirements:
        if "extra ==" not in line:
            requirement = re.match(r"[\w.-]+", line)[0]
            try:
                found |= {requirement} | core(distribution(requirement).requires or [])
            except ModuleNotFoundError:  # for another platform
                continue
    return found


def test_the_wheel_is_every_file_of_the_package_under_the_name_of_the_project(wheel: Path) -> None:
    kept = subprocess.run(["git", "ls-files", "tween"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = set(kept.stdout.split())
    assert {"tween/py.typed", "tween/__init__.py", "tween/__init__.pyi", "tween/plot/player.html"} <= files
    assert {path.relative_to(wheel).as_posix() for path in wheel.glob("tween/**/*") if path.is_file()} == files
    (about,) = wheel.glob("*.dist-info/METADATA")
    assert f"Name: {PROJECT['name']}\n" in about.read_text()
    assert f"Version: {PROJECT['version']}\n" in about.read_text()
    assert {path.name.partition("-")[0] for path in wheel.iterdir()} == {"tween", PROJECT["name"].replace("-", "_")}


@pytest.mark.parametrize("line", ["gallery", "morph gallery:arrow disk -o out.gif --frames 3 --size 48"])
def test_the_command_runs_with_the_core_dependencies_alone(wheel: Path, tmp_path: Path, line: str) -> None:
    names = {re.sub(r"[-_.]+", "-", name).lower() for name in core(PROJECT["dependencies"])}
    modules = [
        module
        for module, owners in packages_distributions().items()
        if any(re.sub(r"[-_.]+", "-", owner).lower() in names for owner in owners)
    ]
    assert "numba" in modules
    assert "pandas" not in modules
    command = [sys.executable, "-c", ALONE, PROJECT["scripts"]["tween"], "tween", *modules, "--", *line.split()]
    environment = {"PYTHONPATH": str(wheel), "NUMBA_DISABLE_JIT": "1"}  # compiling would take longer than all else
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout
    assert "-o" not in line or (tmp_path / "out.gif").stat().st_size > 100


# As users import it

USER = """
import numpy as np
from numpy.typing import NDArray
import tween

curve: tween.Curve = tween.gallery.curve("ell")
answer = tween.decompose(curve)
T: tween.Triangulation = answer.arbitrary()
m: tween.Morph = tween.morph(T, T.on_disk(), path="metric")
frames: NDArray[np.float64] = m.frames(5)
certificate: tween.Certificate = tween.certify(m, frames=5)
print(answer.count, frames.shape, certificate.valid, tween.area_rank(tween.area_matrix(m)))
"""


def checked(program: str, wheel: Path, folder: Path) -> str:
    """Return what mypy says of a program where the wheel is installed."""
    (folder / "user.py").write_text(program)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-incremental", "user.py"]
    environment = {**os.environ, "PYTHONPATH": str(wheel)}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True).stdout


@pytest.mark.slow
def test_a_user_program_passes_strict_type_checks_and_a_mistaken_one_does_not(wheel: Path, tmp_path: Path) -> None:
    assert checked(USER, wheel, tmp_path) == "Success: no issues found in 1 source file\n"
    said = checked(f"{USER}\nwrong: str = answer.count\ntween.morf(T, T)\n", wheel, tmp_path)
    assert '(expression has type "int", variable has type "str")' in said
    assert 'Module has no attribute "morf"' in said
    assert "Found 2 errors" in said


def test_the_same_program_runs(wheel: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(wheel), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", USER]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    count, *shape, valid, rank = re.findall(r"\w+", done.stdout)
    assert int(count) > 1
    assert [int(n) for n in shape] == [5, len(tween.gallery.curve("ell")), 2]
    assert valid == "True"
    assert int(rank) > 1


def fresh(code: str) -> str:
    """Run some lines in an interpreter that has imported nothing."""
    return subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout


def test_a_folder_is_imported_when_it_is_first_used() -> None:
    assert fresh('import tween; print(len(tween.gallery.curve("ell")))') == f"{len(tween.gallery.curve('ell'))}\n"


def test_importing_the_package_imports_nothing_that_takes_long() -> None:
    loaded = {name.partition(".")[0] for name in fresh("import sys, tween; print(*sys.modules)").split()}
    assert "tween" in loaded
    assert not loaded & {"numpy", "numba", "scipy", "shapely", "matplotlib", "PIL"}
    # The same look sees them where they are.
    assert {"numba", "numpy"} <= set(fresh("import sys, tween; tween.decompose; print(*sys.modules)").split())


def test_every_public_name_is_there_and_no_other() -> None:
    names = fresh("import tween; print(*sorted(tween.__all__))").split()
    assert "morph" in names
    assert len(names) <= 45
    assert fresh("import tween; print([x for x in tween.__all__ if not hasattr(tween, x)])") == "[]\n"
    assert fresh("import tween; print(set(tween.__all__) <= set(dir(tween)))") == "True\n"
    with pytest.raises(AttributeError, match="morf"):
        _ = tween.morf


def test_a_module_imported_first_hides_no_public_name() -> None:
    code = "import tween.morphing.morph, tween.morphing.strategy, tween; print(tween.morph, tween.io.__name__)"
    assert re.match(r"<function morph at .*> tween\.io$", fresh(code))
