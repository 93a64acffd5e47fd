"""Show on the pages of the gallery the GIF and SVG files that its scripts write."""

import shutil
from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst

FILMS = (".gif", ".svg")


def _get_sg_image_scraper() -> Any:
    """Tell sphinx-gallery what to call after each block of a script."""
    return show_films


def show_films(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Copy the films that the block has written to where the gallery keeps its pictures, and show them."""
    pictures = block_vars["image_path_iterator"]
    folder, own = Path(pictures.image_path).parent, Path(pictures.image_path).name.partition("{")[0]
    # Films of other scripts, and of earlier blocks of this one; what is left of an earlier build is made anew.
    shown = [
        path.read_bytes()
        for path in _films(folder)
        if not path.name.startswith(own) or str(path.with_suffix(".png")) in pictures.paths
    ]
    text = ""
    for film in _films(Path.cwd()):
        if film.read_bytes() not in shown:
            picture = Path(pictures.next()).with_suffix(film.suffix)
            shutil.copyfile(film, picture)
            text += figure_rst([picture], gallery_conf["src_dir"], f"The file {film.name}")
    return text


def _films(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.suffix in FILMS)
