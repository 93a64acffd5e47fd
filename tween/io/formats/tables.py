"""Tables of points: CSV as spreadsheets and programs write it."""

import re
import reprlib
from typing import NamedTuple

import numpy as np

from tween.errors import FileError
from tween.io.formats.content import Content, Outline

_WORD = re.compile(r"\W*[^\W\d]")
_NUMBERS = re.compile(r"(?i)\W*(i|n|no|nr|id|index|number|vertex|point|row|)\W*")  # names of a column that counts rows
_FRAMES = {"frame", "time", "vertex", "x", "y"}


class _Layout(NamedTuple):
    """Where x and y stand in a row."""

    separator: str | None
    columns: int
    x: int
    y: int
    decimal: str
    unused: list[str]


def read_csv(data: bytes) -> Content:
    r"""Read points, one a line.

    Parameters
    ----------
    data : bytes
        UTF-8.  Fields are separated by semicolons, commas or white space; where that is not a comma, numbers may have
        decimal commas.  Empty lines and lines that begin with "#" do not count, and the first one may be a header.
        Of more than two columns the header has to name one x and one y; without a header, the first of three may
        count the rows.

    Returns
    -------
    Content
        One outline.

    Raises
    ------
    FileError
        Naming the line.

    Examples
    --------
    >>> read_csv(b"x,y\n0,0\n1.5,2").outlines[0].points.tolist()
    [[0.0, 0.0], [1.5, 2.0]]
    >>> read_csv(b"index;y;x\n0;0,5;1,5\n1;2,5;3,5").outlines[0].points.tolist()
    [[1.5, 0.5], [3.5, 2.5]]
    """
    lines = [(i, line.strip("\r\n")) for i, line in enumerate(text_of(data).splitlines(), 1)]
    lines = [(i, line) for i, line in lines if line.strip() and line.strip()[0] != "#"]
    if not lines:
        return Content([], [], {})
    first = lines[0][1]
    separator = _separator(first)
    fields = _fields(first, separator)
    is_header = all(not _is_number(field, ",") and (not field or _WORD.match(field)) for field in fields)
    header = fields if is_header and len(fields) > 1 else None
    rows = lines[1:] if header else lines
    layout = _layout(header, rows, separator)
    points = np.array([_row(i, line, layout) for i, line in rows]).reshape(-1, 2)
    return Content([Outline("", points)], layout.unused, {})


def text_of(data: bytes) -> str:
    """Decode a file.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    str

    Raises
    ------
    FileError
        Where it is no UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"has the byte {data[error.start]:#04x} at position {error.start}, expected UTF-8") from None


def _separator(line: str) -> str | None:
    """What separates fields; None for white space."""
    if ";" in line:
        return ";"
    if "\t" in line and "," in line and not re.search(r",\s", line):
        return "\t"  # the commas are decimal
    return "," if "," in line else None


def _layout(header: list[str] | None, rows: list[tuple[int, str]], separator: str | None) -> _Layout:
    decimal = _decimal(rows, separator)
    if header is None:
        counts = _counts_rows(rows, separator, decimal)
        return _Layout(separator, 3, 1, 2, decimal, []) if counts else _Layout(separator, 2, 0, 1, decimal, [])
    if set(header) == _FRAMES:
        raise FileError("holds the frames of a morph, expected the points of one curve")
    words = [re.findall(r"[a-z]+", field.lower()) for field in header]
    xs, ys = ([c for c, found in enumerate(words) if name in found] for name in "xy")
    if len(xs) == len(ys) == 1 and xs != ys:
        (x,), (y,) = xs, ys
        others = [field for c, field in enumerate(header) if c not in (x, y) and not _NUMBERS.fullmatch(field)]
        unused = [f"column {reprlib.repr(field)}" for field in others]
        return _Layout(separator, len(header), x, y, decimal, unused)
    if len(header) == 2:
        return _Layout(separator, 2, 0, 1, decimal, [])
    raise FileError(f"has the columns {reprlib.repr(', '.join(header))}, expected one named x and one named y")


def _decimal(rows: list[tuple[int, str]], separator: str | None) -> str:
    """The decimal mark: a comma where it separates nothing and no number has a point."""
    if separator == ",":
        return "."
    return "," if any("," in line for _, line in rows) and not any("." in line for _, line in rows) else "."


def _counts_rows(rows: list[tuple[int, str]], separator: str | None, decimal: str) -> bool:
    """Whether the first of three columns counts the rows, from 0 or 1."""
    first = [_fields(line, separator)[0] for _, line in rows if len(_fields(line, separator)) == 3]
    return len(first) == len(rows) and any(first == [str(k + start) for k in range(len(rows))] for start in (0, 1))


def _fields(line: str, separator: str | None) -> list[str]:
    return [field.strip().strip('"').strip() for field in line.split(separator)]


def _row(i: int, line: str, layout: _Layout) -> list[float]:
    fields = _fields(line, layout.separator)
    wanted = [fields[c] for c in (layout.x, layout.y)] if len(fields) == layout.columns else []
    if not wanted or not all(_is_number(field, layout.decimal) for field in wanted):
        columns = "two numbers, x and y" if layout.columns == 2 else f"{layout.columns} fields with x and y"
        raise FileError(f"line {i} is {reprlib.repr(line.strip())}, expected {columns}")
    return [float(field.replace(layout.decimal, ".")) for field in wanted]


def _is_number(field: str, decimal: str) -> bool:
    try:
        return "_" not in field and float(field.replace(decimal, ".", 1)) is not None
    except ValueError:
        return False
