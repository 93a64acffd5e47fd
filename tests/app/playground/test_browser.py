"""The playground in a browser: JupyterLab is started, the notebook is run, a curve is drawn with the mouse.

`python tests/app/playground/test_browser.py` takes the picture of it that the notebook shows anew.
"""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsers import BEAN, EIGHT, draw, horseshoe, missing, new_page, pixels, place, touch, words

from tween import verify
from tween.io.frames import read_frames

ROOT = Path(__file__).resolve().parents[3]
NOTEBOOK = "10_playground.ipynb"
MISSING = missing("anywidget", "ipywidgets", "jupyterlab", "playwright")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        bool(MISSING), reason=f"needs Chromium and the extras playground and browser; missing: {', '.join(MISSING)}"
    ),
]


@contextmanager
def lab(folder: Path) -> Iterator[str]:
    """Serve the folder of notebooks by JupyterLab, without a person's settings; yields its address."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = folder.parent / "own"
    settings = own / "settings" / "@jupyterlab" / "apputils-extension" / "notification.jupyterlab-settings"
    settings.parent.mkdir(parents=True)
    settings.write_text(json.dumps({"checkForUpdates": False, "fetchNews": "false"}))
    names = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    command = [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--allow-root",
        f"--LabApp.user_settings_dir={own}/settings",
    ]
    command += [f"--LabApp.workspaces_dir={own}/workspaces", "--ServerApp.token=", "--ServerApp.password="]
    command += [
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        f"--ServerApp.root_dir={folder}",
    ]
    env = os.environ | {name: str(own / name.lower()) for name in names}
    with (folder.parent / "lab.log").open("w") as log:
        server = subprocess.Popen(command, env=env, stdout=log, stderr=subprocess.STDOUT)
        try:
            wait_for(f"http://127.0.0.1:{port}/api/status", server)
            yield f"http://127.0.0.1:{port}"
        finally:
            server.terminate()
            server.wait(30)


def wait_for(address: str, server: subprocess.Popen[bytes]) -> None:
    """Return once the address answers."""
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    for _ in range(240):
        if server.poll() is not None:
            break
        try:
            opener.open(address, timeout=5).close()
            return
        except OSError:
            time.sleep(0.25)
    raise RuntimeError("JupyterLab did not start; see lab.log beside its folder")


@contextmanager
def opened(address: str) -> Iterator[Any]:
    """Open the notebook in the browser and run it; yields the page, once the widget is there."""
    with new_page() as page:
        page.goto(f"{address}/lab/tree/{NOTEBOOK}?reset")
        page.get_by_text("| Idle").wait_for()
        page.get_by_role("menuitem", name="Run", exact=True).click()
        page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        page.locator(".tween-playground").wait_for()
        yield page


def folder_of_notebooks(parent: Path) -> Path:
    """Copy what the notebook needs, its outputs left out."""
    folder = parent / "notebooks"
    folder.mkdir()
    content = json.loads((ROOT / "notebooks" / NOTEBOOK).read_text())
    for cell in content["cells"]:
        if cell["cell_type"] == "code":
            cell.update(outputs=[], execution_count=None)
    (folder / NOTEBOOK).write_text(json.dumps(content))
    for path in (ROOT / "notebooks").glob("*.csv"):
        shutil.copy(path, folder)
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return folder_of_notebooks(tmp_path_factory.mktemp("playground"))


@pytest.fixture(scope="module")
def page(folder: Path) -> Iterator[Any]:
    with lab(folder) as address, opened(address) as page:
        yield page


# What a person does


def test_a_curve_drawn_with_the_mouse_gets_its_verdict_at_once(page: Any) -> None:
    draw(page, "source", *BEAN)
    assert words(page, "source").startswith("Bounds an immersed disk.") and "clockwise" not in words(page, "source")
    assert words(page, "morph").startswith("Every shape bounds a disk")
    draw(page, "source", *EIGHT)
    assert words(page, "source").startswith("Bounds no disk: it turns as much to the right as to the left")
    assert words(page, "morph").startswith("No morph")
    draw(page, "source", *horseshoe())
    assert re.match(r"Bounds an immersed disk\. \d+ vertices, 2 crossings, ", words(page, "source"))


def test_a_finger_draws_too(page: Any) -> None:
    touch(page, "source", *EIGHT)
    assert words(page, "source").startswith("Bounds no disk")
    touch(page, "source", *BEAN)
    assert words(page, "source").startswith("Bounds an immersed disk.")


def test_the_second_curve_is_drawn_or_chosen(page: Any) -> None:
    draw(page, "source", *BEAN)
    for choice, verdict in (("S", "Bounds an immersed disk."), ("draw", "Draw a closed curve"), ("disk", "A disk of")):
        page.locator(".tween-target select").select_option(choice)
        page.locator(".tween-target .tween-words", has_text=verdict).wait_for()
    draw(page, "target", *horseshoe())
    page.locator(".tween-target .tween-words", has_text="Bounds an immersed disk.").wait_for()
    assert page.locator(".tween-target select").input_value() == "draw"


def test_the_slider_moves_the_shape_by_mouse_and_by_keys(page: Any) -> None:
    draw(page, "source", *BEAN)
    words(page, "morph")
    slider, clock = page.locator(".tween-slider"), page.locator(".tween-morph .tween-head output")
    seen = []
    for key, time_shown in (("Home", "t = 0.00"), ("ArrowRight", "t = 0.01"), ("End", "t = 1.00")):
        slider.press(key)
        assert clock.inner_text() == time_shown
        seen.append([pixels(page, "morph"), pixels(page, "areas"), pixels(page, "sums")])
    box = slider.bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert clock.inner_text() == "t = 0.50"
    assert all(a != b for a, b in zip(seen[0], seen[2], strict=True))
    page.locator(".tween-play").click()
    page.locator(".tween-morph .tween-head output", has_text="t = 1.00").wait_for()


def test_choices_are_obeyed_and_a_click_makes_a_triangle_the_root(page: Any) -> None:
    draw(page, "source", *BEAN)
    page.locator(".tween-target select").select_option("disk")
    assert "the others by construction" in words(page, "morph")
    page.locator(".tween-choices input").uncheck()
    page.locator(".tween-morph .tween-words", has_text="the others are not proved").wait_for()
    page.locator(".tween-slider").press("Home")
    before = pixels(page, "morph")
    page.mouse.click(*place(page, "morph", np.array(0.3), np.array(0.5)))
    assert words(page, "morph").startswith("Every shape bounds a disk")
    root = page.locator(".tween-choices select").nth(2)
    assert root.locator("option:checked").inner_text().startswith("triangle ")
    assert pixels(page, "morph") != before
    page.locator(".tween-choices select").nth(1).select_option("random")
    page.get_by_role("button", name="another").click()
    assert words(page, "morph").startswith("Every shape bounds a disk")
    assert root.locator("option:checked").inner_text() == "middle of the disk"


def test_files_are_saved_beside_the_notebook_and_downloaded(page: Any, folder: Path, tmp_path: Path) -> None:
    draw(page, "source", *BEAN)
    words(page, "morph")
    page.locator(".tween-foot select").select_option("npz")
    page.locator(".tween-save").click()
    page.locator(".tween-message", has_text="Saved tween_frames.npz").wait_for()
    frames, triangles, times = read_frames(folder / "tween_frames.npz")
    assert verify(frames, triangles, times).valid
    page.locator(".tween-foot select").select_option("gif")
    with page.expect_download() as download:
        page.locator(".tween-download").click()
    download.value.save_as(tmp_path / "animation.gif")
    assert download.value.suggested_filename == "tween_animation.gif"
    assert (tmp_path / "animation.gif").read_bytes().startswith(b"GIF89a")
    assert not (folder / "tween_animation.gif").exists()


def test_the_next_cell_takes_up_what_was_drawn(page: Any) -> None:
    draw(page, "source", *BEAN)
    verdict = words(page, "source")
    cell = page.locator(".jp-CodeCell", has_text="sketch = play.sketch")
    cell.locator(".cm-content").click()
    page.keyboard.press("Shift+Enter")
    cell.locator(".jp-OutputArea-output", has_text=verdict).wait_for()


def test_the_notebook_runs_to_its_end(page: Any, folder: Path) -> None:
    before = (folder / NOTEBOOK).stat().st_mtime_ns
    page.get_by_role("menuitem", name="File", exact=True).click()
    page.get_by_role("menuitem", name=re.compile("^Save Notebook(?! As)")).first.click()
    while (folder / NOTEBOOK).stat().st_mtime_ns == before:
        page.wait_for_timeout(100)
    cells = [c for c in json.loads((folder / NOTEBOOK).read_text())["cells"] if c["cell_type"] == "code"]
    assert all(cell["execution_count"] for cell in cells)
    assert [
        o for cell in cells for o in cell["outputs"] if o["output_type"] == "error" or o.get("name") == "stderr"
    ] == []
    assert cells[-1]["outputs"][0]["text"] == ["True\n"]


def test_nothing_is_asked_of_the_network_and_no_script_fails(page: Any) -> None:
    hosts = {urllib.parse.urlsplit(url).hostname for url in page.wanted if not url.startswith(("data:", "blob:"))}
    assert hosts == {"127.0.0.1"}
    assert page.faults == []


def take_picture(path: Path) -> None:
    """Take the picture that the notebook shows: a curve drawn by hand, half-way to a letter."""
    with tempfile.TemporaryDirectory() as parent:
        with lab(folder_of_notebooks(Path(parent))) as address, opened(address) as page:
            draw(page, "source", *horseshoe())
            page.locator(".tween-target select").select_option("e")
            page.locator(".tween-target .tween-words", has_text="Bounds").wait_for()
            words(page, "morph")
            box = page.locator(".tween-slider").bounding_box()
            page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + box["height"] / 2)
            page.mouse.move(0, 0)
            page.evaluate("document.activeElement.blur()")
            page.locator(".tween-playground").screenshot(path=path)


if __name__ == "__main__":
    take_picture(ROOT / "notebooks" / "playground.png")
