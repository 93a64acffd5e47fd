"""Gather in one folder what the documentation is made of: its pages, the scripts of the gallery, the notebooks.

Sphinx reads one folder, the notebooks lie in another, and the gallery writes pages while it is built.  So all is
copied below the output, and nothing is written beside the sources.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path

DOCS = Path(__file__).resolve().parent.parent
ROOT = DOCS.parent
SCRIPTS = "_scripts"  # in which the gallery runs its scripts, and they write files
GALLERY = "examples"  # the pages that the gallery makes

# A picture or a link of a notebook, to a file of the project outside the folder of the notebooks.
LINK = re.compile(r"(?P<mark>!?)\[(?P<text>[^]]*)\]\(\.\./(?P<path>[^)#\s]+)\)")


def gather(folder: Path) -> Path:
    """Copy all sources into a folder; a file that is there already and has not changed is left as it is."""
    wanted = dict(_sources())
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if path.is_file() and name.parts[0] != GALLERY and name not in wanted:
            path.unlink()
    for name, content in wanted.items():
        path = folder / name
        if not path.exists() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    return folder


def _sources() -> Iterator[tuple[Path, bytes]]:
    for page in DOCS.rglob("*.rst"):
        yield page.relative_to(DOCS), page.read_bytes()
    for script in (DOCS / "examples").iterdir():
        if script.is_file():
            yield Path(SCRIPTS, script.name), script.read_bytes()
    for notebook in (ROOT / "notebooks").glob("*.ipynb"):
        text, files = told_of_files(notebook.read_text(encoding="utf-8"))
        yield Path("notebooks", notebook.name), text.encode()
        for file in files:
            yield file, (ROOT / file).read_bytes()
    for picture in (ROOT / "notebooks").glob("*.png"):
        yield Path("notebooks", picture.name), picture.read_bytes()


def told_of_files(notebook: str) -> tuple[str, set[Path]]:
    """Find the files of the project to which a notebook leads, and make plain text of what leads to a folder."""
    content, files = json.loads(notebook), set()

    def kept(link: re.Match[str]) -> str:
        if (ROOT / link["path"]).is_file():
            files.add(Path(link["path"]))
            return link[0]
        return link["text"]

    for cell in content["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = LINK.sub(kept, "".join(cell["source"]))
    return json.dumps(content), files
