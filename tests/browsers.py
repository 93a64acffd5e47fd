"""What tests in a browser share: Chromium, a page that is listened to, and a hand that draws."""

import importlib.util
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from tween import gallery

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
CHROMIUM = next((path for path in map(shutil.which, BROWSERS) if path), None)
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--no-proxy-server",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def missing(*packages: str) -> list[str]:
    """What is not there of packages and Chromium."""
    return [name for name in packages if importlib.util.find_spec(name) is None] + ([] if CHROMIUM else ["Chromium"])


@contextmanager
def new_page(width: int = 1360, height: int = 1000) -> Iterator[Any]:
    """An empty page, which remembers what was asked of the network and what went wrong."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": width, "height": height})
        page.set_default_timeout(120_000)
        page.wanted, page.faults = [], []
        page.on("request", lambda request: page.wanted.append(request.url))
        page.on("pageerror", lambda error: page.faults.append(str(error)))
        yield page
        browser.close()


# A hand


def place(page: Any, field: str, x: Any, y: Any) -> list[list[float]]:
    """Points of a field that is 1 wide and high, y up, on the page."""
    canvas = page.locator(f".tween-{field} canvas")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    return np.stack([box["x"] + box["width"] * x, box["y"] + box["height"] * (1 - y)], axis=-1).tolist()


def draw(page: Any, field: str, x: Any, y: Any) -> None:
    """Draw with the mouse."""
    points = place(page, field, x, y)
    page.mouse.move(*points[0])
    page.mouse.down()
    for point in points[1:]:
        page.mouse.move(*point)
    page.mouse.up()


def touch(page: Any, field: str, x: Any, y: Any) -> None:
    """Draw with a finger."""
    session = page.context.new_cdp_session(page)
    points = [{"x": a, "y": b} for a, b in place(page, field, x, y)]
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": points[:1]})
    for point in points[1:]:
        session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


def words(page: Any, field: str) -> str:
    """What is said below a field, once the kernel has answered."""
    page.locator(".tween-playground:not(.tween-busy)").wait_for()
    return str(page.locator(f".tween-{field} .tween-words").inner_text())


def pixels(page: Any, field: str) -> str:
    return str(page.locator(f".tween-{field} canvas").evaluate("canvas => canvas.toDataURL()"))


TIME = np.linspace(0, 2 * np.pi, 70)
BEAN = 0.5 + 0.36 * np.cos(TIME), 0.5 + 0.3 * np.sin(TIME) + 0.06 * np.cos(3 * TIME)
EIGHT = 0.5 + 0.35 * np.sin(2 * TIME), 0.5 + 0.4 * np.sin(TIME)


def horseshoe() -> tuple[Any, Any]:
    """A curve whose ends overlap, as a hand that trembles a little draws it."""
    points = gallery.curve("horseshoe").points
    points = (points - points.min(axis=0)) / np.ptp(points, axis=0).max() * 0.84 + [0.16, 0.06]
    points = np.concatenate([points, points[:4]])
    return tuple((points + np.random.default_rng(1).normal(0, 0.003, points.shape)).T)
