"""The documentation: it builds without a warning, its code runs, its links lead somewhere, and nothing is fetched."""

import doctest
import importlib.util
import inspect
import json
import os
import pkgutil
import re
import runpy
import shlex
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path
from textwrap import dedent
from types import ModuleType
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import pytest

import tween

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
REFERENCE = sorted((DOCS / "api").rglob("*.rst"))
PAGES = sorted(set(DOCS.rglob("*.rst")) - set(REFERENCE))
SCRIPTS = sorted((DOCS / "examples").glob("*.py"))
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def name_of(path: Path) -> str:
    """Return the path as the documentation spells it."""
    return path.relative_to(DOCS).with_suffix("").as_posix()


# The reference


def documented(text: str) -> set[str]:
    """Return the full names that the directives of a page document."""
    names, module = set(), ""
    for directive, argument in re.findall(r"^\.\. (currentmodule|py:module|auto\w+):: *(\S+)", text, re.MULTILINE):
        if directive == "currentmodule":
            module = argument
        elif argument:
            names.add(argument if argument.startswith("tween.") else f"{module}.{argument}")
    return names


@pytest.mark.parametrize("name", tween.__all__)
def test_every_public_name_is_on_a_page_of_the_reference(name: str) -> None:
    assert any(f"tween.{name}" in documented(page.read_text(encoding="utf-8")) for page in REFERENCE)


@pytest.mark.parametrize("name", [name for name in tween.__all__ if isinstance(getattr(tween, name), ModuleType)])
def test_every_function_and_class_of_a_module_with_a_short_name_is_on_a_page_of_the_reference(name: str) -> None:
    module = getattr(tween, name)
    shown = {
        key
        for key, value in vars(module).items()
        if inspect.isclass(value) or (inspect.isfunction(value) and inspect.get_annotations(value))
    }
    own = {key for key in shown if getattr(module, key).__module__ == module.__name__ and not key.startswith("_")}
    wanted = shown & set(getattr(module, "__all__", own))  # kernels have no annotations
    on_pages = set().union(*(documented(page.read_text(encoding="utf-8")) for page in REFERENCE))
    assert {key for key in wanted if not {f"tween.{name}.{key}", f"tween.{key}"} & on_pages} == set()


@pytest.mark.parametrize("name", tween.__all__)
def test_every_public_name_is_in_the_list_of_the_reference(name: str) -> None:
    assert re.search(rf"^   {name}$", (DOCS / "api" / "index.rst").read_text(encoding="utf-8"), re.MULTILINE)


def module_of(page: Path) -> str:
    """Return the module of which a page of the reference is: that of a folder is its index."""
    return ".".join(["tween", *page.relative_to(DOCS / "api").with_suffix("").parts]).removesuffix(".index")


def listed(page: Path) -> set[Path]:
    """Return the pages that the table of contents of a page names."""
    contents = page.read_text(encoding="utf-8").partition(".. toctree::")[2]
    return {(page.parent / entry).with_suffix(".rst") for entry in re.findall(r"^   ([\w/]+)$", contents, re.MULTILINE)}


@pytest.mark.parametrize("page", [path for path in REFERENCE if path != DOCS / "api" / "index.rst"], ids=name_of)
def test_every_page_of_the_reference_is_of_a_module_that_exists_and_is_listed(page: Path) -> None:
    assert find_spec(module_of(page))
    assert module_of(page) in documented(page.read_text(encoding="utf-8"))
    assert sum(page in listed(index) for index in REFERENCE) == 1


@pytest.mark.slow
def test_every_module_is_on_the_map_and_explained_there_or_in_the_reference(built: Path) -> None:
    text = (built / "inside.html").read_text(encoding="utf-8")
    on_pages = {module_of(page) for page in REFERENCE}
    for module in pkgutil.walk_packages(tween.__path__, "tween."):
        if not module.name.endswith("__main__"):
            assert f">{module.name}<" in text
            assert module.name in on_pages or f'id="module-{module.name}"' in text, module.name


# The code


class Block(NamedTuple):
    """Code of a page, and the line at which it starts."""

    kind: str
    text: str
    line: int
    needs: tuple[str, ...] = ()


BLOCK = re.compile(
    r"^\.\. (?P<kind>code-block:: (?:python|console)|plot::) *\n"
    r"(?P<options>(?:   :.*\n)*)\n"
    r"(?P<text>(?:(?:   .*)?\n)+)",
    re.MULTILINE,
)


def blocks(text: str) -> Iterator[Block]:
    """Yield the code of a page: Python, Python that plots and knows nothing of the rest, or typed into a console."""
    for found in BLOCK.finditer(text):
        kind = found["kind"].removeprefix("code-block:: ").rstrip(":")
        needs = tuple(re.findall(r"\bneeds-(\w+)", found["options"]))
        yield Block(kind, dedent(found["text"]).strip("\n") + "\n", text.count("\n", 0, found.start("text")) + 1, needs)


def run_python(block: Block, name: str, names: dict[str, Any]) -> list[str]:
    """Run code as a script, or as a session whose answers are compared; return what went wrong."""
    if ">>> " not in block.text:
        exec(compile("\n" * (block.line - 1) + block.text, name, "exec"), names)
        return []
    complaints: list[str] = []
    session = doctest.DocTestParser().get_doctest(block.text, names, name, name, block.line - 1)
    doctest.DocTestRunner(verbose=False, optionflags=FLAGS).run(session, out=complaints.append, clear_globs=False)
    names.update(session.globs)
    return complaints


def commands(text: str) -> list[tuple[str, str]]:
    """Split what was typed into a console from what came back: "$ " starts a command, a backslash goes on with it."""
    typed = re.split(r"^\$ ", text.replace("\\\n", " "), flags=re.MULTILINE)[1:]
    return [(command.partition("\n")[0], command.partition("\n")[2]) for command in typed]


def run_console(block: Block, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """Run the commands of a console that are ours, and compare their answers where the page shows any."""
    from tween.app.command_line.main import main

    complaints = []
    for command, shown in commands(block.text):
        words = shlex.split(command, comments=True)
        if words[0] != "tween":
            continue
        capsys.readouterr()
        main(words[1:])
        came = "".join(capsys.readouterr())
        if shown and not doctest.OutputChecker().check_output(shown, came, FLAGS):
            complaints.append(f"{command}: shown is\n{shown}, but it answers\n{came}")
    return complaints


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_code_of_a_page_does_what_the_page_shows(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tween.app.command_line.stages.PATIENCE", 600.0)  # what is compiled depends on the cache
    names: dict[str, Any] = {"__name__": "__main__"}  # where workers do not look for what is defined
    complaints = []
    for block in blocks(page.read_text(encoding="utf-8")):
        if any(find_spec(package) is None for package in block.needs):
            compile(block.text, name_of(page), "exec")
        elif block.kind == "python":
            complaints += run_python(block, f"{name_of(page)}.rst", names)
        else:
            complaints += run_console(block, capsys)
        plt.close("all")
    assert not complaints, "\n".join(complaints)


def test_code_that_does_not_do_what_is_shown_is_seen() -> None:
    page = "Text.\n\n.. code-block:: python\n\n   >>> 1 + 1\n   3\n\nText.\n\n"
    page += ".. plot::\n   :context:\n\n   x = 1\n\n   y = x\n"
    first, second = blocks(page)
    assert (first.text, first.line) == (">>> 1 + 1\n3\n", 5)
    assert (second.text, second.line) == ("x = 1\n\ny = x\n", 13)
    assert len(run_python(first, "page", {})) == 1
    names: dict[str, Any] = {}
    assert run_python(second, "page", names) == []
    assert names["y"] == 1


def test_commands_are_told_from_their_answers() -> None:
    text = "$ tween info a.csv\nyes\n1 crossing\n$ tween morph a \\\n    b -o c.gif\n"
    (first, answer), (second, nothing) = commands(text)
    assert (first, answer, nothing) == ("tween info a.csv", "yes\n1 crossing\n", "")
    assert shlex.split(second) == ["tween", "morph", "a", "b", "-o", "c.gif"]


# The gallery of examples


@pytest.mark.slow
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_of_the_gallery_runs_and_shows_something(
    script: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if ".mp4" in script.read_text(encoding="utf-8"):
        pytest.importorskip("imageio_ffmpeg", reason="needs the extra 'video': pip install '.[video]'")
    monkeypatch.chdir(tmp_path)
    with plt.rc_context():
        runpy.run_path(str(script), run_name="__main__")
    shown = [*plt.get_fignums(), *tmp_path.glob("*.gif"), *tmp_path.glob("*.svg")]
    plt.close("all")
    assert shown
    assert capsys.readouterr().out


def test_scripts_of_the_gallery_are_short() -> None:
    assert len(SCRIPTS) >= 10
    assert max(len(script.read_text(encoding="utf-8").splitlines()) for script in SCRIPTS) <= 50


# What is gathered for the build


@pytest.fixture(scope="module")
def sources() -> ModuleType:
    """Load what gathers the sources of the documentation."""
    spec = importlib.util.spec_from_file_location("sources", DOCS / "_extensions" / "sources.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_what_a_notebook_shows_is_gathered_and_what_leads_to_a_folder_is_plain(sources: ModuleType) -> None:
    text = "![a](../results/figures/gallery.png), [b](../experiments/studies) and [c](01_immersions.ipynb)"
    notebook = {"cells": [{"cell_type": "markdown", "source": [text]}, {"cell_type": "code", "source": ["x = 1"]}]}
    told, files = sources.told_of_files(json.dumps(notebook))
    assert files == {Path("results/figures/gallery.png")}
    assert json.loads(told)["cells"][0]["source"] == text.replace("[b](../experiments/studies)", "b")
    assert json.loads(told)["cells"][1] == notebook["cells"][1]


def test_sources_that_are_gathered_again_are_left_as_they_are_and_stale_ones_go(
    sources: ModuleType, tmp_path: Path
) -> None:
    sources.gather(tmp_path)
    page, stale, made = (tmp_path / name for name in ("index.rst", "howto/stale.rst", "examples/index.rst"))
    page.write_text("changed")
    for path in (stale, made):
        path.parent.mkdir(exist_ok=True)
        path.write_text("")
    before = (tmp_path / "mathematics.rst").stat().st_mtime_ns
    sources.gather(tmp_path)
    assert page.read_bytes() == (DOCS / "index.rst").read_bytes()
    assert (stale.exists(), made.exists()) == (False, True)
    assert (tmp_path / "mathematics.rst").stat().st_mtime_ns == before


# The built pages


class Page(HTMLParser):
    """What a built page refers to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: set[str] = set()
        self.loads: set[str] = set()
        self.unresolved: set[str] = set()
        self._open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {key: value or "" for key, value in attrs}
        self.anchors |= {given[key] for key in ("id", "name") if key in given}
        if tag == "a" and "href" in given:
            self.links.add(given["href"])
        elif tag == "link" and given.get("rel") in {"stylesheet", "icon", "preload", "preconnect"}:
            self.loads.add(given["href"])
        if "src" in given:
            self.loads.add(given["src"])
        if tag == "a":
            self._open.append(tag)
        if tag == "code" and "xref" in given.get("class", "").split() and not self._open:
            self.unresolved.add(self.get_starttag_text() or "")

    def handle_endtag(self, tag: str) -> None:
        if tag == "a" and self._open:
            self._open.pop()


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the documentation, warnings being errors."""
    pytest.importorskip("sphinx", reason="needs the extra 'docs': pip install '.[docs]'")
    folder = tmp_path_factory.mktemp("docs")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", str(DOCS), str(folder)]
    env = {**os.environ, "PYTHONWARNINGS": "default"}
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder


def pages(folder: Path) -> dict[Path, Page]:
    return {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}


def link_faults(page: Path, found: dict[Path, Page]) -> list[str]:
    """Name each link and each picture that leads nowhere in the built documentation."""
    faults = []
    for link in sorted(found[page].links | found[page].loads):
        address, _, anchor = link.partition("#")
        if re.match(r"\w+:", address):
            continue
        goal = (page.parent / address.partition("?")[0]).resolve() if address else page
        if not goal.exists():
            faults.append(f"{link}: no such file")
        elif anchor and goal in found and anchor not in found[goal].anchors:
            faults.append(f"{link}: no such place")
    return faults


@pytest.mark.slow
def test_the_links_and_pictures_of_the_built_pages_exist(built: Path) -> None:
    found = pages(built)
    assert len(found) > 20
    assert {str(page): faults for page in found if (faults := link_faults(page, found))} == {}


@pytest.mark.slow
def test_names_in_the_prose_are_names_of_the_reference(built: Path) -> None:
    prose = [built / f"{name_of(page)}.html" for page in PAGES if page.stem != "inside"]
    prose += [built / "examples" / f"{script.stem}.html" for script in SCRIPTS]
    unresolved = {str(page): Page(page.read_text(encoding="utf-8")).unresolved for page in prose}
    assert {page: names for page, names in unresolved.items() if names} == {}


@pytest.mark.slow
def test_the_built_pages_fetch_nothing(built: Path) -> None:
    assert {load for page in pages(built).values() for load in page.loads if re.match(r"(\w+:)?//", load)} == set()
    styles = "\n".join(path.read_text(encoding="utf-8") for path in built.rglob("*.css"))
    assert re.findall(r"(?:url\(|@import)\s*[\"']?(?:https?:)?//[^)\"']*", styles) == []


@pytest.mark.slow
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_of_the_gallery_has_a_page_with_pictures_and_a_thumbnail(script: Path, built: Path) -> None:
    pictures = f"_images/sphx_glr_{script.stem}_"
    assert f"{pictures}0" in (built / "examples" / f"{script.stem}.html").read_text(encoding="utf-8")
    assert f"{pictures}thumb" in (built / "examples" / "index.html").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_a_notebook_is_shown_with_its_stored_pictures(notebook: Path, built: Path) -> None:
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    stored = sum("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", []))
    page = (built / "notebooks" / f"{notebook.stem}.html").read_text(encoding="utf-8")
    assert len(re.findall(r'<img [^>]*src="\.\./_images/', page)) >= stored > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("word", "page"),
    [
        ("hole", "howto/recognise"),
        ("loop", "howto/keyframes"),
        ("loop", "examples/09_looping_keyframes"),
        ("repair", "howto/repair"),
        ("landmark", "howto/landmarks"),
        ("keyfram", "howto/keyframes"),
    ],
)
def test_a_search_finds_the_page_about_it(word: str, page: str, built: Path) -> None:
    text = (built / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("{") : text.rindex("}") + 1])
    places = index["titleterms"].get(word, [])
    found = [index["docnames"][i] for i in ([places] if isinstance(places, int) else places)]
    assert page in found


@pytest.mark.slow
def test_code_can_be_copied(built: Path) -> None:
    page = Page((built / "howto" / "command_line.html").read_text(encoding="utf-8"))
    assert any("copybutton.js" in load for load in page.loads)


def test_a_link_to_nowhere_is_seen(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<p id="here"><a href="b.html#x">b</a><a href="#here">here</a><img src="c.png">')
    (tmp_path / "b.html").write_text('<a href="https://example.org">out</a>')
    found = pages(tmp_path.resolve())
    assert link_faults(tmp_path.resolve() / "a.html", found) == ["b.html#x: no such place", "c.png: no such file"]
    assert link_faults(tmp_path.resolve() / "b.html", found) == []


def test_a_name_that_leads_nowhere_is_seen() -> None:
    resolved = '<a href="api/curve.html"><code class="xref py py-obj"><span>tween.Curve</span></code></a>'
    unresolved = '<code class="xref py py-obj docutils literal"><span>tween.Curvature</span></code>'
    assert Page(resolved + "<code>plain</code>").unresolved == set()
    assert len(Page(resolved + unresolved).unresolved) == 1
