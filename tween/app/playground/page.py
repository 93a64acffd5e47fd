"""The playground as a page in a browser, without JupyterLab: the same widget, served by Voilà.

    tween play -> a notebook of one cell -> Voilà on 127.0.0.1, with a token -> the browser

Nothing here imports Voilà, or anything else that the extra "play" brings along, before it is to serve.  The page asks
nothing of the network.
"""

import importlib.util
import json
import os
import secrets
import socket
import sys
import tempfile
import threading
import webbrowser
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

from tween.errors import FileError, TweenError
from tween.geometry.curve import Curve
from tween.io.writing import write_curve

HOST = "127.0.0.1"
"""The only address at which it listens: other machines cannot reach it."""

_NEEDED = ("voila", "anywidget", "ipywidgets")
_EXTENSIONS = ["@voila-dashboards/widgets-manager8", "@jupyter-widgets/jupyterlab-manager", "anywidget"]
_SOCKET, _LONGEST_SOCKET = 72, 103  # characters of a socket's name below a folder, and those that systems allow
_TEMPLATE = Path(__file__).with_name("template")
_PACKAGE_FOLDER = Path(__file__).resolve().parents[3]


def serve(curve: Curve | None = None, port: int | None = None, browser: bool = True) -> None:
    """Serve a playground to the browsers of this machine until it is interrupted.

    Parameters
    ----------
    curve : Curve, optional
        To begin with; otherwise one of the gallery.
    port : int, optional
        Where to listen; any free one unless given.
    browser : bool
        Whether to open a browser.  Its command line does not hold the token, which others on this machine could read.

    Raises
    ------
    TweenError
        Where a package is missing; the message says which extra has it.
    FileError
        Where the port is taken.
    """
    missing = [name for name in _NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        extra = "pip install '.[play]' in the project's folder"
        raise TweenError(f"the playground in a browser needs {' and '.join(missing)}: {extra}")
    port, token = _free(port), secrets.token_urlsafe(24)
    address = f"http://{HOST}:{port}/?token={token}"
    with tempfile.TemporaryDirectory(prefix="tween_play_") as folder:
        notebook = write_notebook(Path(folder), curve)

        def announce() -> None:
            print(f"the playground is at {address}\nCtrl-C ends it", flush=True)
            if browser:
                _open(address, Path(folder))

        _listen(notebook, port, token, announce)
    print("stopped")


def _free(port: int | None) -> int:
    """The port, or one that is free, as far as can be known."""
    with socket.socket() as tried:
        tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            tried.bind((HOST, port or 0))
        except OSError as error:
            raise FileError(
                f"port {port} of {HOST} cannot be used: {error.strerror}; without --port, a free one is found"
            ) from None
        number: int = tried.getsockname()[1]
        return number


def write_notebook(folder: Path, curve: Curve | None = None) -> Path:
    """Write the notebook that is shown: a heading, and one cell.

    Parameters
    ----------
    folder : Path
        Of its own.
    curve : Curve, optional
        To begin with.

    Returns
    -------
    Path
        Of the notebook.  Its cell saves files in what is the current folder now.

    Examples
    --------
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     notebook = write_notebook(Path(folder))
    ...     print(notebook.name, len(json.loads(notebook.read_text())["cells"]))
    playground.ipynb 2
    """
    path = None
    if curve is not None:
        path = str(write_curve(folder / "curve.npz", curve))
    lines = [
        "import sys",
        f"sys.path.insert(0, {str(_PACKAGE_FOLDER)!r})",
        "from tween.app.playground.widget import on_page",
        f"on_page({path!r}, {str(Path.cwd())!r})",
    ]
    heading = {"cell_type": "markdown", "id": "heading", "metadata": {}, "source": "# tween playground"}
    cell = {"cell_type": "code", "id": "widget", "metadata": {}, "source": "\n".join(lines)}
    content = {
        "cells": [heading, cell | {"execution_count": None, "outputs": []}],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "title": "tween playground",
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    notebook = folder / "playground.ipynb"
    notebook.write_text(json.dumps(content), encoding="utf-8")
    return notebook


def _listen(notebook: Path, port: int, token: str, announce: Callable[[], None]) -> None:
    """Run Voilà until it is interrupted, whatever a person's settings of Jupyter say."""
    import logging

    from tornado.ioloop import IOLoop
    from voila.app import Voila

    logging.getLogger("tornado").setLevel(logging.ERROR)
    server = Voila(config=_settings(notebook, port, token), config_file_paths=[])
    server.initialize([])
    server.template_paths.insert(0, str(_TEMPLATE))
    IOLoop.current().add_callback(announce)
    server.start()


def _settings(notebook: Path, port: int, token: str) -> Any:
    from traitlets.config import Config

    server = {
        "ip": HOST,
        "port": port,
        "port_retries": 0,
        "token": token,
        "open_browser": False,
        "notebook_path": str(notebook),
        "connection_dir_root": str(notebook.parent),
        "log_level": 40,
        # A page of another name that leads to this machine is refused.
        "tornado_settings": {"allow_remote_access": False, "local_hostnames": ["localhost", HOST]},
    }
    return Config(
        {
            "Voila": server,
            "VoilaConfiguration": {"extension_allowlist": _EXTENSIONS, "file_allowlist": []},
            "KernelSpecManager": {"kernel_dirs": []},  # the Python that runs this, and no other
            "KernelManager": {"transport": "ipc"} if _takes_sockets(notebook.parent) else {},
        }
    )


def _takes_sockets(folder: Path) -> bool:
    """Whether sockets may lie below a folder: then others on this machine cannot reach the kernel either."""
    return sys.platform != "win32" and len(os.fsencode(folder)) + _SOCKET <= _LONGEST_SOCKET


def _open(address: str, folder: Path) -> None:
    """Open a browser by a file that leads to the address, and that only this person can read."""
    page = folder / "open.html"
    page.write_text(f'<!doctype html><meta http-equiv="refresh" content="0; url={escape(address)}">', encoding="utf-8")
    threading.Thread(target=webbrowser.open, args=(page.as_uri(),), daemon=True).start()
