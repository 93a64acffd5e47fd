"""How Sphinx builds this documentation; nothing is fetched, and nothing is written outside the output folder."""

import inspect
import os
import pkgutil
import re
import sys
import tomllib
from importlib import import_module
from pathlib import Path
from typing import Any

# Pictures are drawn to files, so no screen is needed.
os.environ["MPLBACKEND"] = "Agg"

from docutils import nodes
from docutils.utils.math import unichar2tex
from docutils.utils.math.latex2mathml import tex2mathml
from matplotlib import rc_params_from_file
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

import tween

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_extensions"))

import sources  # noqa: E402  what lies beside this file

project = "tween"
author = "The tween developers"
copyright = author
version = release = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "matplotlib.sphinxext.plot_directive",
    "sphinx_gallery.gen_gallery",
    "sphinx_copybutton",
    "myst_nb",
]
exclude_patterns = [sources.SCRIPTS]

# Docstrings: `name` in single backquotes is a name of tween; types are explained in words, with shapes and units.
default_role = "py:obj"
add_module_names = True
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autosummary_generate = False
napoleon_google_docstring = False
napoleon_custom_sections = [("Attributes", "params_style")]
napoleon_use_rtype = False
viewcode_line_numbers = True

# Pictures are drawn by the code beside them, in the project's style, at twice the size of a plain screen.
plot_include_source = True
plot_html_show_source_link = False
plot_html_show_formats = False
plot_formats = [("png", 200)]
plot_pre_code = ""
plot_rcparams = dict(rc_params_from_file(HERE.parent / "tween" / "plot" / "tween.mplstyle", use_default_template=False))
plot_apply_rcparams = True

# The gallery: each script is run, and what it prints, draws and writes is shown.  Times of a run are not.
sphinx_gallery_conf = {
    "examples_dirs": sources.SCRIPTS,
    "gallery_dirs": sources.GALLERY,
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("films", "matplotlib"),
    "capture_repr": (),
    "notebook_extensions": set(),
    "download_all_examples": False,
    "remove_config_comments": True,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "show_signature": False,
    "backreferences_dir": None,
    "abort_on_example_error": True,
}

# The notebooks are shown as they were last run; their widgets would need scripts from elsewhere.
nb_execution_mode = "off"
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
nb_merge_streams = True
myst_enable_extensions = ["dollarmath"]

# What is copied of a console is what was typed.
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
copybutton_line_continuation_character = "\\"

COLOURED = ("brand-primary", "brand-content", "api-name", "api-pre-name")
html_theme = "furo"
html_title = f"tween {release}"
html_static_path = ["_static"]
html_css_files = ["tween.css"]
html_copy_source = False
html_show_sourcelink = False
html_math_renderer = "mathml"
html_theme_options = {
    "light_css_variables": {f"color-{part}": "#0072B2" for part in COLOURED},
    "dark_css_variables": {f"color-{part}": "#56B4E9" for part in COLOURED},
}
pygments_style = "friendly"
pygments_dark_style = "monokai"


def draw_as_drawn(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Keep drawings and tables of a module's docstring as they were typed: what is indented, or has wide gaps."""
    if what != "module":
        return
    kept: list[str] = []
    for paragraph in "\n".join(lines).split("\n\n"):
        rows = paragraph.split("\n")
        if rows[0].startswith(" ") or any(re.search(r"\S {3,}\S", row) for row in rows):
            kept += [".. code-block:: text", "   :class: drawing", "", *(f"   {row}" for row in rows), ""]
        else:
            kept += [*rows, ""]
    lines[:] = kept


def keep_initials(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Keep an initial at the start of a line from becoming the number of a list."""
    lines[:] = [re.sub(r"^(\s*)([A-Z]\. )", r"\1\\\2", line) for line in lines]


def join_sentence(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Put together again what napoleon takes for a type and a text: the sentence of a property around its colon."""
    found = [line for line in lines if line.startswith(":type: ")]
    if what in {"property", "attribute"} and found:
        lines[:] = [
            f"{found[0].removeprefix(':type: ')}: {lines[0]}",
            *(line for line in lines[1:] if line not in found),
        ]


def link_result(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Make a link of what a function returns, where that is a class of tween."""
    lines[:] = [re.sub(r"^:returns: \*([A-Z]\w+)\*", r":returns: :py:class:`.\1`", line) for line in lines]


def hide_constructor(
    app: Sphinx, what: str, name: str, obj: object, options: object, arguments: str | None, result: str | None
) -> tuple[str, str] | None:
    """Show no arguments for a class that a function makes: nobody calls it."""
    by_hand = name.rpartition(".")[2] in {"Curve", "Triangulation"}
    return ("", "") if what == "class" and not by_hand else None


def skip_members(app: Sphinx, what: str, name: str, obj: object, skip: bool, options: object) -> bool | None:
    """Leave out what a module imports from other packages, and fields of named tuples: they are in Attributes."""
    foreign = not str(getattr(obj, "__module__", None) or "tween").startswith("tween")
    return True if (what == "module" and foreign) or type(obj).__name__ == "_tuplegetter" else None


def first_line(module: str) -> str:
    """Return the sentence with which the docstring of a module starts."""
    return (inspect.getdoc(import_module(module)) or "").partition("\n")[0]


def all_modules() -> list[str]:
    """List the modules of tween, folders before what is in them, in the order of tween's own docstring."""
    order = re.findall(r"^    (\w+)  +\S", tween.__doc__ or "", re.MULTILINE)
    found = [found.name for found in pkgutil.walk_packages(tween.__path__, "tween.") if "__" not in found.name]

    def place(module: str) -> tuple[int, str]:
        room = module.split(".")[1]
        return (order.index(room) if room in order else -1), module

    return sorted(found, key=place)


def page_of(module: str) -> str | None:
    """Return the page of the reference about a module, as the documentation spells it; None where there is none."""
    path = module.removeprefix("tween.").replace(".", "/")
    return next((f"api/{page}" for page in (path, f"{path}/index") if (HERE / "api" / f"{page}.rst").exists()), None)


def list_pages(name: str, text: str) -> str:
    """Say what each module below a page of the reference is about."""
    lines = []
    for page in re.findall(r"^   ([\w/]+)$", text.partition(".. toctree::")[2], re.MULTILINE):
        module = ".".join(["tween", *Path(name).parts[1:-1], *Path(page).parts]).removesuffix(".index")
        lines.append(f"\n* :doc:`{module} <{page}>`: {first_line(module)}")
    return "".join(lines) + "\n"


def draw_map() -> str:
    """Write one sentence about each module, folder by folder, and explain those without a page in the reference."""
    rooms, details = "", ""
    for module in all_modules():
        page, depth = page_of(module), module.count(".") - 1
        link = f":doc:`{module} <{page}>`" if page else f":py:mod:`{module}`"
        rooms += f"\n{'  ' * depth}* {link}: {first_line(module)}\n"
        if not page:
            details += f"\n{module}\n{'-' * len(module)}\n\n.. automodule:: {module}\n"
    return rooms + details


def list_modules(app: Sphinx, name: str, source: list[str]) -> None:
    """Complete the pages that list modules: those of the reference that have pages below them, and the map."""
    if name.startswith("api/") and ".. toctree::" in source[0]:
        source[0] += list_pages(name, source[0])
    if name == "inside":
        source[0] += draw_map()


def lead_back(app: Sphinx, name: str, template: str, context: dict[str, Any], doctree: nodes.document | None) -> None:
    """Mend links from source code to the reference: viewcode expects one prefix for all names of a module."""
    if not name.startswith("_modules/"):
        return
    places = [(place.docname, known) for known, place in app.env.domaindata["py"]["objects"].items()]

    def mended(link: re.Match[str]) -> str:
        page, parts = link["page"], link["name"].split(".")
        for i in range(len(parts)):
            tail = ".".join(parts[i:])
            for docname, known in places:
                if docname == page and f".{known}".endswith(f".{tail}"):
                    return f"{link['way']}{page}.html#{known}"
        return link[0]

    context["body"] = re.sub(r"(?P<way>(?:\.\./)+)(?P<page>[\w/]+)\.html#(?P<name>[\w.]+)", mended, context["body"])


def as_mathml(self: HTML5Translator, node: nodes.math | nodes.math_block) -> None:
    """Write a formula in MathML, which browsers show by themselves: no script, no font, no network."""
    block = isinstance(node, nodes.math_block)
    text = node.astext().translate(unichar2tex.uni2tex_table).replace(r"\dots", r"\ldots")  # which docutils knows
    formula = tex2mathml(text, as_block=block)
    formula = re.sub(r"\s*\n\s*", "", formula)
    self.body.append(f'<div class="formula">{formula}</div>\n' if block else formula)
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register what is above; read the sources where they are gathered, below the output."""
    app.srcdir = type(app.srcdir)(sources.gather(Path(app.doctreedir) / "sources"))
    app.connect("autodoc-process-docstring", draw_as_drawn, priority=100)  # before napoleon, whose priority is 500
    app.connect("autodoc-process-docstring", join_sentence, priority=900)
    app.connect("autodoc-process-docstring", keep_initials, priority=900)
    app.connect("autodoc-process-docstring", link_result, priority=900)
    app.connect("autodoc-process-signature", hide_constructor)
    app.connect("autodoc-skip-member", skip_members)
    app.connect("source-read", list_modules)
    app.connect("html-page-context", lead_back)
    app.add_html_math_renderer("mathml", inline_renderers=(as_mathml, None), block_renderers=(as_mathml, None))
    return {"parallel_read_safe": False, "parallel_write_safe": True}
