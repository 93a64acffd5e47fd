"""The playground as a page: who can reach it, how it ends, and what a person does there, in a browser.

What needs Voilà, Chromium or the extra browser is skipped where that is missing, and says so.
"""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import urllib.parse
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsers import BEAN, EIGHT, draw, missing, new_page, pixels, place, words

from tween import gallery, verify
from tween.app.playground import page as served
from tween.app.playground.fields import BOX, fitting
from tween.errors import FileError
from tween.io.frames import read_frames
from tween.io.reading import read_curve

LACKING = [name for name in missing("voila", "anywidget", "ipywidgets") if name != "Chromium"]
WITHOUT = missing("voila", "anywidget", "ipywidgets", "playwright")
serving = pytest.mark.skipif(bool(LACKING), reason=f"needs the extra play; missing: {', '.join(LACKING)}")
browsing = pytest.mark.skipif(
    bool(WITHOUT), reason=f"needs Chromium and the extras play and browser; missing: {', '.join(WITHOUT)}"
)


# Before it is served


def test_a_port_that_is_taken_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(served, "_NEEDED", ())
    with socket.socket() as taken:
        taken.bind((served.HOST, 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(FileError, match=rf"^port {port} of 127\.0\.0\.1 cannot be used: .*without --port"):
            served.serve(port=port)


def test_the_notebook_shows_the_curve_and_saves_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = served.write_notebook(tmp_path, gallery.letter("e"))
    source = json.loads(path.read_text())["cells"][1]["source"]
    shown: list[Any] = []
    monkeypatch.setattr("tween.app.playground.widget.on_page", lambda *given: shown.append(given))
    monkeypatch.setattr(sys, "path", list(sys.path))
    exec(source, {})
    ((curve, folder),) = shown
    assert np.array_equal(read_curve(curve).points, gallery.letter("e").points)
    assert Path(folder) == tmp_path


def test_the_kernel_is_reached_by_files_where_their_names_are_short_enough() -> None:
    assert served._takes_sockets(Path("/tmp/tween_play_12345678")) == (sys.platform != "win32")
    assert not served._takes_sockets(Path("/var/folders") / ("a" * 40))


def test_the_command_line_of_the_browser_does_not_hold_the_token(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(served.threading.Thread, "start", lambda thread: thread.run())
    monkeypatch.setattr(served.webbrowser, "open", opened.append)
    served._open("http://127.0.0.1:1/?token=secret", tmp_path)
    (address,) = opened
    assert "secret" not in address
    assert "url=http://127.0.0.1:1/?token=secret" in Path(urllib.parse.urlsplit(address).path).read_text()


# The server


@contextmanager
def playing(folder: Path, *words: str) -> Iterator[tuple[Any, str]]:
    """Run `tween play` in a folder; yields the process and the address that it prints."""
    command = [sys.executable, "-m", "tween", "play", "--no-browser", *words]
    names = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    env = os.environ | {name: str(folder.parent / "own" / name.lower()) for name in names}
    # what runs in the background of a shell ignores interrupts, and so would its children
    signal.signal(signal.SIGINT, signal.default_int_handler)
    pipe = subprocess.PIPE
    with subprocess.Popen(
        command, cwd=folder, env=env, stdout=pipe, stderr=pipe, text=True, start_new_session=True
    ) as process:
        try:
            line = process.stdout.readline()
            address = re.search(r"http://127\.0\.0\.1:\d+/\?token=\S{20,}", line)
            assert address, line + process.stderr.read()
            yield process, address[0]
        finally:
            process.terminate()


def answer(address: str, path: str = "/", **headers: str) -> tuple[int, str, str]:
    """Ask for a page; returns the status, where it leads, and what it says."""
    parts = urllib.parse.urlsplit(address)
    with closing(http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=120)) as asked:
        asked.request("GET", path, headers=headers)
        got = asked.getresponse()
        return got.status, got.getheader("Location", ""), got.read().decode()


@serving
@pytest.mark.slow
def test_it_answers_nobody_without_the_token_from_elsewhere_or_by_another_name_and_ends_in_one_line(
    tmp_path: Path,
) -> None:
    folder = tmp_path / "here"
    folder.mkdir()
    with playing(folder) as (process, address):
        port = int(urllib.parse.urlsplit(address).port or 0)
        assert process.stdout.readline() == "Ctrl-C ends it\n"
        for path in ("/", "/?token=wrong", "/voila/files/playground.ipynb", "/api/kernels/a-b-c-d-e"):
            status, location, _ = answer(address, path)
            assert status in (302, 403) and (status == 403 or location.startswith("/login"))
        assert answer(address, "/?" + address.partition("?")[2], Host="example.org")[0] == 403
        with pytest.raises(OSError):  # it listens at one address, and at no other of this machine
            socket.create_connection(("127.0.0.2", port), timeout=5).close()
        again = subprocess.run(
            [sys.executable, "-m", "tween", "play", "--port", str(port)], capture_output=True, text=True, cwd=folder
        )
        assert (again.returncode, again.stdout, again.stderr.count("\n")) == (2, "", 1)
        assert again.stderr.startswith(f"tween: port {port} of 127.0.0.1 cannot be used")
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        rest = process.communicate(timeout=60)
        assert (process.returncode, *rest) == (0, "stopped\n", "")
        assert not list(folder.iterdir())


# What a person does


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("play") / "here"
    folder.mkdir()
    return folder


@pytest.fixture(scope="module")
def page(folder: Path) -> Iterator[Any]:
    with playing(folder, "gallery:arrow") as (_, address), new_page(1280) as page:
        page.goto(address)
        page.locator(".tween-playground").wait_for()
        yield page


def choose(page: Any, source: str, target: str) -> None:
    """Begin anew with two curves that come with tween."""
    page.locator(".tween-source select").select_option(source)
    page.locator(".tween-target select").select_option(target)
    words(page, "morph")


def tool(page: Any, name: str) -> None:
    page.get_by_role("radio", name=name).check()


def vertex(page: Any, field: str, name: str, v: int) -> list[float]:
    """Where a vertex of a curve of the gallery is on the page."""
    points = gallery.curve(name).points
    x, y = np.reshape(fitting(points).forth(points), (-1, 2))[v] / BOX
    return place(page, field, np.array([x]), np.array([y]))[0]


def note(page: Any, field: str) -> str:
    line = page.locator(f".tween-{field} .tween-note")
    line.wait_for()
    return str(line.inner_text())


@browsing
@pytest.mark.slow
def test_a_curve_is_drawn_explained_mended_undone_and_had_again(page: Any) -> None:
    assert words(page, "source").startswith("Bounds an immersed disk. 43 vertices")  # the one that was asked for
    draw(page, "source", *EIGHT)
    no = words(page, "source")
    assert no.startswith("Bounds no disk: it turns as much") and "Without the dashed loop it bounds one" in no
    drawn = pixels(page, "source")
    page.locator(".tween-source").get_by_role("button", name="Mend it").click()
    page.locator(".tween-source .tween-words", has_text="Bounds an immersed disk.").wait_for()
    assert words(page, "morph").startswith("Every shape bounds a disk")
    page.keyboard.press("Control+z")
    page.locator(".tween-source .tween-words", has_text="Bounds no disk").wait_for()
    assert words(page, "source") == no and pixels(page, "source") == drawn
    page.keyboard.press("Control+Shift+z")
    page.locator(".tween-source .tween-words", has_text="Bounds an immersed disk.").wait_for()
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Undo").click()
    page.locator(".tween-source .tween-words", has_text="43 vertices").wait_for()
    page.get_by_role("button", name="Redo").click()
    page.locator(".tween-source .tween-words", has_text="Bounds no disk").wait_for()


@browsing
@pytest.mark.slow
def test_files_are_handed_in_and_a_bad_one_loses_nothing(page: Any, tmp_path: Path) -> None:
    choose(page, "loop", "disk")
    files = {
        "triangle.csv": "0,0\n2,0\n0,2\n",
        "two.json": '{"curves": {"a": [[0, 0], [1, 0], [0, 1]], "b": [[0, 0], [2, 0], [2, 2], [0, 2]]}}',
        "bad.svg": "<svg",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    source, target = (page.locator(f".tween-{field} input[type=file]") for field in ("source", "target"))
    target.set_input_files(tmp_path / "triangle.csv")
    page.locator(".tween-target .tween-words", has_text="3 vertices").wait_for()
    target.set_input_files(tmp_path / "two.json")
    page.locator(".tween-target .tween-note", has_text="holds 2 curves").wait_for()
    page.locator(".tween-source select").select_option("two.json: b")
    page.locator(".tween-source .tween-words", has_text="4 vertices").wait_for()
    before = words(page, "source"), words(page, "morph"), pixels(page, "source")
    source.set_input_files(tmp_path / "bad.svg")
    page.locator(".tween-source .tween-note", has_text="bad.svg: ").wait_for()
    assert "\n" not in note(page, "source")
    assert (words(page, "source"), words(page, "morph"), pixels(page, "source")) == before


@browsing
@pytest.mark.slow
def test_landmarks_are_clicked_numbered_obeyed_and_removed(page: Any) -> None:
    choose(page, "arrow", "ell")
    without = pixels(page, "morph")
    tool(page, "Landmarks")
    for source, target in ((0, 12), (20, 30)):
        page.mouse.click(*vertex(page, "source", "arrow", source))
        page.mouse.click(*vertex(page, "target", "ell", target))
        page.locator(".tween-landmarks", has_text=f"{source} → {target}").wait_for()
        assert words(page, "morph").startswith("Every shape bounds a disk")
    assert page.locator(".tween-landmarks b").all_inner_texts() == ["1", "2"]
    assert pixels(page, "morph") != without
    page.mouse.click(*vertex(page, "source", "arrow", 30))
    page.mouse.click(*vertex(page, "target", "ell", 20))
    page.locator(".tween-morph .tween-words", has_text="not in the same order around both curves").wait_for()
    page.get_by_role("button", name="remove landmark 3, vertex 30 to vertex 20").click()
    page.locator(".tween-morph .tween-words", has_text="Every shape bounds a disk").wait_for()
    page.mouse.click(*vertex(page, "source", "arrow", 0))  # a landmark that is clicked goes
    page.locator(".tween-landmarks li").nth(1).wait_for(state="detached")
    assert page.locator(".tween-landmarks li").all_inner_texts()[0].split() == ["1", "20", "→", "30", "×"]
    choose(page, "loop", "disk")
    assert page.locator(".tween-landmarks li").count() == 0


@browsing
@pytest.mark.slow
def test_the_verdict_follows_a_vertex_that_is_dragged(page: Any) -> None:
    choose(page, "arrow", "disk")
    tool(page, "Move vertices")
    x, y = vertex(page, "source", "arrow", 4)
    side = page.locator(".tween-source canvas").bounding_box()["width"]
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(8):
        page.mouse.move(x, y - 0.05 * side * k)  # through the other side of the arrow's tail
    page.locator(".tween-source .tween-words", has_text="Bounds no disk").wait_for()  # while it is held
    page.mouse.move(x + 0.02 * side, y)
    page.mouse.up()
    page.locator(".tween-source .tween-words", has_text="Bounds an immersed disk").wait_for()
    assert words(page, "morph").startswith("Every shape bounds a disk")
    assert page.locator(".tween-source select option:checked").inner_text() == "arrow, changed"
    page.get_by_role("button", name="Undo").click()  # the whole drag at once
    page.locator(".tween-source .tween-words", has_text="Bounds an immersed disk. 43").wait_for()
    words(page, "morph")
    assert page.locator(".tween-source select").input_value() == "arrow"


@browsing
@pytest.mark.slow
def test_keys_do_what_the_pointer_does(page: Any) -> None:
    choose(page, "arrow", "ell")
    tool(page, "Move vertices")
    source, target = (page.locator(f".tween-{field} canvas") for field in ("source", "target"))
    source.focus()
    before = pixels(page, "source")
    for key in ("Space", "Space", "Space", "Shift+Space"):
        page.keyboard.press(key)
    assert source.get_attribute("aria-label") == "From: field to draw in; vertex 1 of 43"
    page.keyboard.press("Shift+ArrowUp")
    page.keyboard.press("ArrowLeft")
    page.locator(".tween-source select option:checked", has_text="arrow, changed").wait_for(state="attached")
    page.wait_for_timeout(700)
    assert words(page, "source").startswith("Bounds an immersed disk. 43 vertices") and pixels(page, "source") != before
    page.keyboard.press("Enter")
    target.focus()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")
    page.locator(".tween-landmarks", has_text="1 → 0").wait_for()
    words(page, "morph")
    page.keyboard.press("Delete")
    page.locator(".tween-landmarks li").wait_for(state="detached")
    page.keyboard.press("Delete")
    page.locator(".tween-target .tween-words", has_text="46 vertices").wait_for()
    words(page, "morph")
    page.keyboard.press("Escape")
    assert target.get_attribute("aria-label") == "To: field to draw in"
    page.keyboard.press("Control+z")
    page.locator(".tween-target .tween-words", has_text="47 vertices").wait_for()
    words(page, "morph")
    page.locator(".tween-morph canvas").press("ArrowRight")
    page.locator(".tween-choices select option:checked", has_text="triangle ").wait_for(state="attached")
    assert words(page, "morph").startswith("Every shape bounds a disk")


@browsing
@pytest.mark.slow
def test_a_morph_is_played_saved_and_downloaded(page: Any, folder: Path, tmp_path: Path) -> None:
    choose(page, "arrow", "ell")
    page.get_by_role("button", name="play", exact=True).click()
    page.locator(".tween-morph .tween-head output", has_text="t = 1.00").wait_for()
    page.get_by_role("combobox", name="kind of file").select_option("npz")
    page.get_by_role("button", name="Save here").click()
    page.locator(".tween-message", has_text="Saved tween_frames.npz").wait_for()
    frames, triangles, times = read_frames(folder / "tween_frames.npz")
    assert verify(frames, triangles, times).valid
    for kind, beginning in (("gif", b"GIF89a"), ("svg", b"<")):
        page.get_by_role("combobox", name="kind of file").select_option(kind)
        with page.expect_download() as download:
            page.get_by_role("button", name="Download").click()
        download.value.save_as(tmp_path / f"animation.{kind}")
        assert (tmp_path / f"animation.{kind}").read_bytes().startswith(beginning)


@browsing
@pytest.mark.slow
@pytest.mark.parametrize("width", [1280, 800, 390])
def test_nothing_is_cut_or_covered(page: Any, width: int) -> None:
    choose(page, "arrow", "ell")
    page.get_by_role("button", name="Keys").click()
    page.set_viewport_size({"width": width, "height": 900})
    page.wait_for_timeout(300)
    assert page.locator(".tween-playground").evaluate(OVERLAPS) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.locator(".tween-download").scroll_into_view_if_needed()
    box = page.locator(".tween-download").bounding_box()
    assert 0 <= box["y"] <= 900 - box["height"]
    page.get_by_role("button", name="Keys").click()
    page.set_viewport_size({"width": 1280, "height": 1000})


# Names of what sticks out of the widget, and of each two that overlap.
OVERLAPS = """root => {
  const tags = "select, button, canvas, label, li, output, p, b";
  const all = [...root.querySelectorAll(tags)].filter((e) => e.offsetParent);
  const boxes = all.map((e) => e.getBoundingClientRect());
  const name = (e) => `${e.tagName} ${e.className} ${e.textContent.slice(0, 20)}`;
  const r = root.getBoundingClientRect();
  const outside = (a) => a.left < r.left - 0.5 || a.right > r.right + 0.5 || a.bottom > r.bottom + 0.5;
  const beside = (a, b) => a.right <= b.left + 0.5 || a.bottom <= b.top + 0.5;
  const cut = (e) => e.matches("button") && e.scrollWidth > e.clientWidth + 1;
  const faults = all.filter((e, i) => outside(boxes[i]) || cut(e)).map(name);
  all.forEach((e, i) => all.slice(0, i).forEach((other, j) => {
    const within = e.contains(other) || other.contains(e);
    const apart = beside(boxes[i], boxes[j]) || beside(boxes[j], boxes[i]);
    if (!within && !apart) faults.push(`${name(other)} | ${name(e)}`);
  }));
  return faults;
}"""


@browsing
@pytest.mark.slow
@pytest.mark.skipif(bool(missing("axe_playwright_python")), reason="needs axe-playwright-python, of the extra browser")
@pytest.mark.parametrize("state", ["morph", "landmarks", "no disk", "bad file"])
def test_there_are_no_serious_faults_of_accessibility(page: Any, state: str, tmp_path: Path) -> None:
    from axe_playwright_python.sync_playwright import Axe

    choose(page, "arrow", "ell")
    if state == "landmarks":
        tool(page, "Landmarks")
        page.mouse.click(*vertex(page, "source", "arrow", 0))
        page.mouse.click(*vertex(page, "target", "ell", 12))
        page.locator(".tween-landmarks li").wait_for()
    elif state == "no disk":
        tool(page, "Draw")
        draw(page, "source", *EIGHT)
    elif state == "bad file":
        (tmp_path / "bad.csv").write_text("no numbers")
        page.locator(".tween-source input[type=file]").set_input_files(tmp_path / "bad.csv")
        page.locator(".tween-source .tween-note", has_text="bad.csv: ").wait_for()
    words(page, "morph")
    page.wait_for_timeout(300)
    found = Axe().run(page).response["violations"]
    assert [(fault["id"], fault["help"]) for fault in found if fault["impact"] in ("serious", "critical")] == []


@browsing
@pytest.mark.slow
def test_a_button_without_a_name_would_be_a_fault(page: Any) -> None:
    pytest.importorskip("axe_playwright_python", reason="needs axe-playwright-python, of the extra browser")
    from axe_playwright_python.sync_playwright import Axe

    page.evaluate("document.querySelector('.tween-bar').append(document.createElement('button'))")
    found = Axe().run(page).response["violations"]
    page.evaluate("document.querySelector('.tween-bar').lastChild.remove()")
    assert "button-name" in [fault["id"] for fault in found]


@browsing
@pytest.mark.slow
def test_nothing_is_asked_of_the_network_and_no_script_fails(page: Any) -> None:
    draw(page, "source", *BEAN)
    hosts = {urllib.parse.urlsplit(url).hostname for url in page.wanted if not url.startswith(("data:", "blob:"))}
    assert hosts == {"127.0.0.1"}
    assert page.faults == []
