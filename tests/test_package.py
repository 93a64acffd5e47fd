"""The wheel: it holds all that the package needs, and works with the core dependencies alone."""

import re
import subprocess
import sys
import zipfile
from importlib.metadata import distribution, packages_distributions
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
# Runs the command as if nothing else were installed than what was named before "--".
ALONE = """
import sys
from importlib.abc import MetaPathFinder

known = set(sys.argv[1 : sys.argv.index("--")]) | set(sys.stdlib_module_names)

class Missing(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in known:
            raise ModuleNotFoundError(f"no module named {name!r} in a plain installation", name=name)

sys.meta_path.insert(0, Missing())
from tween.cli import main
sys.exit(main(sys.argv[sys.argv.index("--") + 1 :]))
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


def core(name: str = "tween") -> set[str]:
    """Names of the distributions that a plain installation brings along."""
    found = {name}
    for line in distribution(name).requires or []:
        if "extra ==" not in line:
            requirement = re.match(r"[\w.-]+", line)[0]
            try:
                found |= core(requirement)
            except ModuleNotFoundError:  # for another platform
                continue
    return found


def test_every_file_of_the_package_is_in_the_wheel(wheel: Path) -> None:
    kept = subprocess.run(["git", "ls-files", "tween"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = kept.stdout.split()
    assert "tween/player.html" in files
    assert [name for name in files if not (wheel / name).is_file()] == []


@pytest.mark.parametrize("line", ["gallery", "morph gallery:arrow disk -o out.gif --frames 3 --size 48"])
def test_the_command_runs_with_the_core_dependencies_alone(wheel: Path, tmp_path: Path, line: str) -> None:
    names = {re.sub(r"[-_.]+", "-", name).lower() for name in core()}
    modules = [
        module
        for module, owners in packages_distributions().items()
        if any(re.sub(r"[-_.]+", "-", owner).lower() in names for owner in owners)
    ]
    assert "numba" in modules
    assert "pandas" not in modules
    command = [sys.executable, "-c", ALONE, "tween", *modules, "--", *line.split()]
    environment = {"PYTHONPATH": str(wheel), "NUMBA_DISABLE_JIT": "1"}  # compiling would take longer than all else
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout
    assert "-o" not in line or (tmp_path / "out.gif").stat().st_size > 100
