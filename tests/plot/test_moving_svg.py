"""Animated SVG and the player: well-formed, complete, and moving in a browser where there is one."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tween import Morph, paper_morph, sequence
from tween.choices import STYLES
from tween.gallery import pair
from tween.plot.film import record
from tween.plot.moving_svg import player, svg

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
QUIET = (
    "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking"
    " --disable-component-update --disable-sync"
).split()
SVG = "{http://www.w3.org/2000/svg}"
# A browser whose clock is made to run fast calls for few pictures; with a timer in their place the page keeps time.
TIMER = "<script>window.requestAnimationFrame = (f) => setTimeout(() => f(performance.now()), 10);</script>"


@pytest.fixture(scope="module")
def m() -> Morph:
    return paper_morph(*pair("comb_to_winding"))


@pytest.fixture
def browse(tmp_path: Path) -> Callable[..., str]:
    """Open a page in a browser for so many milliseconds; returns what the page has become."""
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed, which plays SVG and HTML")

    def open_page(name: str, content: str, milliseconds: int, screenshot: Path | None = None) -> str:
        page = tmp_path / name
        page.write_text(content, encoding="utf-8")
        action = f"--screenshot={screenshot}" if screenshot else "--dump-dom"
        options = (f"--user-data-dir={tmp_path / 'profile'}", f"--virtual-time-budget={milliseconds}", action)
        command = [CHROMIUM, *QUIET, "--window-size=300,300", *options, page.as_uri()]
        return subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout

    return open_page


def polygon(path: str) -> np.ndarray:
    """Read back a path such as M10 20l5-3 0 7z."""
    numbers = np.array(re.findall(r"-?\d+", path), dtype=float).reshape(-1, 2)
    assert re.fullmatch(r"M-?\d+ -?\d+l[-\d ]+z", path)
    return np.cumsum(numbers, axis=0)


@pytest.mark.parametrize("style", STYLES)
def test_an_svg_holds_every_shape_to_a_part_in_ten_thousand(m: Morph, style) -> None:
    shown = record(m, frames=7, style=style)
    root = ET.fromstring(svg(shown))
    animations = [a for a in root.iter(f"{SVG}animate") if a.get("attributeName") == "d"]
    assert len(animations) == 1 + (0 if style == "outline" else len(m.source) - 2)
    assert root.find(f"{SVG}title").text == "Morph of 118 vertices, 212 flips"
    assert max(map(int, root.get("viewBox").split())) == 5000
    unit = 5000 / max(shown.width, shown.height)
    outline = [polygon(path) for path in animations[-1].get("values").split(";")]
    for k, points in zip([0, 0, 1, 2, 3, 4, 5, 6, 6, 5, 4, 3, 2, 1, 0, 0], outline, strict=True):
        assert np.abs(points - unit * shown.shapes[k]).max() <= 0.5 + 1e-9
    if style != "outline":
        triangle = polygon(animations[3].get("values").split(";")[8])
        assert np.abs(triangle - unit * shown.shapes[6][shown.triangles[6, 3]]).max() <= 0.5 + 1e-9


@pytest.mark.parametrize("there_and_back", [True, False])
@pytest.mark.parametrize("hold", [0.0, 0.4])
def test_an_svg_keeps_time(m: Morph, there_and_back: bool, hold: float) -> None:
    shown = record(m, frames=7, fps=10, style="fill", hold=hold, there_and_back=there_and_back)
    for animation in ET.fromstring(svg(shown)).iter(f"{SVG}animate"):
        times = [float(time) for time in animation.get("keyTimes").split(";")]
        assert float(animation.get("dur").rstrip("s")) == pytest.approx(shown.seconds.sum())
        assert times[0] == 0 and times[-1] == 1 and times == sorted(times)
        assert len(times) == len(animation.get("values").split(";"))


def test_an_svg_of_a_hundred_vertices_and_sixty_frames_stays_small(m: Morph) -> None:
    assert len(svg(record(m))) < 700_000
    # Outlines have units a hundred times as fine here, as rounding would break rules in coarser ones.
    assert len(svg(record(m, style="outline"))) < 165_000
    assert len(player(record(m))) < 165_000


@pytest.mark.parametrize("write", [svg, player])
def test_the_same_film_gives_the_same_text_and_asks_nobody_for_more(m: Morph, write) -> None:
    shown = record(m, frames=5)
    text = write(shown)
    assert text == write(record(m, frames=5))
    assert set(re.findall(r"https?://[^\s\"'<]+", text)) == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"\b(src|href|import|fetch)\b", text)


@pytest.mark.parametrize("style", STYLES)
def test_a_browser_plays_an_svg(m: Morph, browse, tmp_path: Path, style) -> None:
    text = svg(record(m, frames=10, fps=5, size=200, hold=0, style=style))
    pictures = []
    for milliseconds in (500, 1500):
        file = tmp_path / f"{milliseconds}.png"
        browse("morph.svg", text, milliseconds, file)
        pictures.append(np.asarray(Image.open(file).convert("L"), dtype=float))
    assert [(picture < 200).any() for picture in pictures] == [True, True]
    assert (np.abs(pictures[0] - pictures[1]) > 60).sum() > 200


def clock(page: str) -> tuple[float, str]:
    """What the player says: the time, and the flips."""
    found = re.search(r"<output[^>]*>t = ([\d.]+), ([^<]*)</output>", page)
    assert found, page[-500:]
    return float(found[1]), found[2]


@pytest.mark.parametrize("style", ["outline", "fill"])
def test_a_browser_plays_a_page(m: Morph, browse, style) -> None:
    text = TIMER + player(record(m, frames=10, fps=5, hold=0.2, ease=False, style=style))
    early, late = (browse("morph.html", text, milliseconds) for milliseconds in (700, 1500))
    assert 0 < clock(early)[0] < clock(late)[0] < 1
    outlines = [re.search(r'class="outline".*? d="([^"]*)"', page)[1] for page in (early, late)]
    assert outlines[0] != outlines[1]


def test_a_page_plays_there_and_back_again_and_again(m: Morph, browse) -> None:
    text = TIMER + player(record(m, frames=10, fps=5, hold=0.2, ease=False, style="outline"))
    times = [clock(browse("morph.html", text, milliseconds))[0] for milliseconds in (2100, 3400, 5400)]
    assert times[0] == 1  # at rest
    assert 0.05 < times[1] < 0.95  # on the way back, until 4000
    assert 0.05 < times[2] < 0.95  # there again


def test_a_page_can_be_paused_and_scrubbed(m: Morph, browse) -> None:
    shown = record(m, frames=11, fps=5, hold=0.2, ease=False)
    text = TIMER + player(shown)
    click = "<script>document.getElementById('play').click();</script>"
    assert clock(browse("paused.html", text + click, 1500)) == (0, "0 of 212 flips")
    scrub = (
        "<script>const place = document.getElementById('place'); place.value = 5;"
        "place.dispatchEvent(new Event('input'));</script>"
    )
    page = browse("scrubbed.html", text + scrub, 1500)
    assert clock(page) == (0.5, f"{shown.flips[5]} of 212 flips")
    unit = 5000 / max(shown.width, shown.height)
    *triangles, outline = (
        np.array(re.findall(r"[\d.]+", path), dtype=float).reshape(-1, 2) for path in re.findall(r' d="([^"]*)"', page)
    )
    assert np.abs(outline - unit * shown.shapes[5]).max() <= 0.6
    assert np.abs(triangles - unit * shown.shapes[5][shown.triangles[5]]).max() <= 0.6


def test_an_opaque_disk_is_its_outline_filled(m: Morph) -> None:
    shown = record(m, frames=5, style="fill", fill="black", stroke="none", background="transparent")
    root = ET.fromstring(svg(shown))
    (group,) = root.iter(f"{SVG}g")
    assert (group.get("fill"), group.get("stroke")) == ("#000000", "none")
    assert len(list(root.iter(f"{SVG}path"))) == 1
    assert not list(root.iter(f"{SVG}rect")), "the background is transparent"
    half = svg(record(m, frames=5, style="fill", fill="#00000080"))
    assert half.count("<path") == 1 + len(m.source) - 2


def test_a_loop_of_keyframes_ends_with_the_shape_that_it_began_with() -> None:
    triangle, square, bar = [[0, 0], [3, 0], [0, 3]], [[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 0], [4, 0], [4, 1], [0, 1]]
    shown = record(sequence([triangle, square, bar], loop=True), frames=20, there_and_back=False, verified=True)
    assert not shown.trouble
    for animate in ET.fromstring(svg(shown)).iter(f"{SVG}animate"):
        first, *_, last = animate.get("values").split(";")
        assert first == last
