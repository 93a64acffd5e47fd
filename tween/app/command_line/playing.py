"""The command ``tween play``: the playground in a browser."""

from types import SimpleNamespace as Options

from tween.app.command_line.shapes import Reading, read_shape
from tween.app.playground import page


def play(options: Options) -> int:
    """Serve a playground until it is interrupted.

    Parameters
    ----------
    options : SimpleNamespace
        file, select, tolerance, pen, smooth, port, browser, verbose.

    Returns
    -------
    int
        0.
    """
    curve = None
    if options.file is not None:
        curve = read_shape(options.file, options.select, Reading(options.tolerance, options.pen, options.smooth)).curve
    page.serve(curve, options.port, options.browser)
    return 0
