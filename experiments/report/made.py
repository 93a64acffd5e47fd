"""How the results were made: parameters, versions, and the machine."""

import importlib
import importlib.metadata
import os
import platform
import re
import tomllib
from itertools import chain
from typing import Any

from experiments.catalogue import STEPS
from experiments.claims.shared import PARAMETERS as CLAIMS
from experiments.figures.registry import SEED
from experiments.store import ROOT


def parameters() -> dict[str, dict[str, Any]]:
    """The parameters of every step that has some."""
    found = {s.module: getattr(importlib.import_module(f"experiments.{s.module}"), "PARAMETERS", {}) for s in STEPS}
    found |= {"claims": CLAIMS, "figures": {"seed": SEED}}
    return {name: values for name, values in found.items() if values}


def versions() -> dict[str, str]:
    """Python, and every package that the project asks for, with its version."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = chain(project["dependencies"], *project["optional-dependencies"].values())
    names = {re.split(r"[^\w.-]", line)[0] for line in wanted} - {project["name"]}
    found = {"Python": platform.python_version(), "tween": project["version"]}
    return found | {name: version(name) for name in sorted(names, key=str.lower)}


def version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def machine() -> str:
    return f"{platform.system()} on {platform.machine()}, {os.cpu_count()} cores"
