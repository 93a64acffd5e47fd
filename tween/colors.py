"""One colour for each idea, in figures, animations and files alike; greys are levels between 0 (black) and 1."""

SOURCE, TARGET, TREE, PIVOT, RANDOM, FAILURE = "#0072B2", "#E69F00", "#009E73", "#AA3377", "0.55", "#D1261B"
INK, EDGE = "0.15", "0.45"


def as_hex(color: str) -> str:
    """Write a colour of this module as SVG does.

    Parameters
    ----------
    color : str

    Returns
    -------
    str

    Examples
    --------
    >>> as_hex(SOURCE), as_hex(INK)
    ('#0072B2', '#262626')
    """
    return color if color.startswith("#") else "#" + 3 * f"{round(255 * float(color)):02x}"
