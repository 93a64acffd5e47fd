"""Files as they arrive, whole and broken: what `test_io` reads, and `test_cli` again through the command."""

import io
import os
import pickle
import zipfile

import numpy as np

from tween.io.formats.svg import DEEPEST, MOST_ELEMENTS
from tween.io.formats.svg_path import MOST_POINTS
from tween.io.formats.whole_files import LARGEST_FILE

SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]


def svg(content):
    return f'<svg xmlns="http://www.w3.org/2000/svg">{content}</svg>'


def npz(**arrays):
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def npy(array):
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


PATH = '<path d="M0 0h1v1z"/>'
BOMB = '<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">' + "".join(
    f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
)
HUGE = "1" + "0" * 400


class _Trap:
    """Unpickling it would leave a trace."""

    def __reduce__(self):
        return (os.abort, ())


def _zip(**members):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(f"{name}.npy", content)
    return stream.getvalue()


def _header(shape):
    """An npy file that announces more than it holds."""
    good = npy(np.zeros((3, 2)))
    return (
        good[:10]
        + str({"descr": "<f8", "fortran_order": False, "shape": shape}).encode().ljust(117)
        + b"\n"
        + good[128:]
    )


MALFORMED = {
    # SVG
    "svg empty": (".svg", ""),
    "svg blank": (".svg", " \n"),
    "svg truncated in a tag": (".svg", svg(PATH)[:60]),
    "svg truncated before its end": (".svg", svg(PATH)[:-3]),
    "svg binary": (".svg", bytes(range(256))),
    "svg that is words": (".svg", "hello world"),
    "svg that is HTML": (".svg", "<html><body/></html>"),
    "svg of two roots": (".svg", svg(PATH) * 2),
    "svg in an unknown encoding": (".svg", '<?xml version="1.0" encoding="klingon"?>' + svg(PATH)),
    "svg in a wrong encoding": (".svg", svg(f"<!-- é -->{PATH}").encode("latin-1")),
    "svg of no shape": (".svg", svg("<g/>")),
    "svg of hidden shapes": (".svg", svg(f'<defs>{PATH}</defs><g display="none">{PATH}</g>')),
    "svg of text": (".svg", svg("<text>M0 0h1v1z</text>")),
    "svg path without data": (".svg", svg("<path/>")),
    "svg path with only a move": (".svg", svg('<path d="M3 3"/>')),
    "svg path with only moves": (".svg", svg('<path d="M3 3m1 1 M4 4z"/>')),
    "svg path of one line": (".svg", svg('<path d="M3 3l1 1"/>')),
    "svg path back and forth": (".svg", svg('<path d="M0 0h3h-3z"/>')),
    "svg path of garbage": (".svg", svg('<path d="M0 0 L blah"/>')),
    "svg path of units": (".svg", svg('<path d="M0px 0px L1cm 2cm z"/>')),
    "svg path of an odd coordinate": (".svg", svg('<path d="M0 0 1 0 1"/>')),
    "svg path of a bad flag": (".svg", svg('<path d="M0 0a1 1 0 7 0 1 1z"/>')),
    "svg path of a negative radius": (".svg", svg('<path d="M0 0a-1 1 0 0 0 1 1z"/>')),
    "svg path of NaN": (".svg", svg('<path d="M0 0LNaN 1 2 2z"/>')),
    "svg path of huge numbers": (".svg", svg(f'<path d="M0 0H{HUGE}V1z"/>')),
    "svg path of huge exponents": (".svg", svg('<path d="M0 0H1e200V1e200z"/>')),
    "svg path of huge curves": (".svg", svg('<path d="M0 0C1.7e308 1.7e308-1.7e308 0 1 1z"/>')),
    "svg path of a tiny arc": (".svg", svg('<path d="M0 0a1e-200 1e-200 0 0 1 1e-190 0z"/>')),
    "svg path that begins with a line": (".svg", svg('<path d="L0 0 1 0 1 1z"/>')),
    "svg path of too many points": (".svg", svg(f'<path d="M{"0 1 1 0 " * (MOST_POINTS // 2 + 1)}"/>')),
    "svg path of many flat curves": (".svg", svg(f'<path d="M0 0{"C0 1e9 0 1e9 1 1" * 20_000}"/>')),
    "svg polygon of an odd coordinate": (".svg", svg('<polygon points="0 0 1 0 1"/>')),
    "svg polygon of words": (".svg", svg('<polygon points="one two three"/>')),
    "svg polygon without points": (".svg", svg('<polygon points=""/>')),
    "svg rectangle without a width": (".svg", svg('<rect height="3"/>')),
    "svg rectangle of percentages": (".svg", svg('<rect width="50%" height="3"/>')),
    "svg rectangle of a negative width": (".svg", svg('<rect width="-1" height="3"/>')),
    "svg circle of words": (".svg", svg('<circle r="big"/>')),
    "svg circle of infinite radius": (".svg", svg('<circle r="1e999"/>')),
    "svg circle of several radii": (".svg", svg('<circle r="1-2"/>')),
    "svg transform of garbage": (".svg", svg(f'<g transform="spin(3">{PATH}</g>')),
    "svg transform that is unknown": (".svg", svg(f'<g transform="spin(3)">{PATH}</g>')),
    "svg transform of too few numbers": (".svg", svg(f'<g transform="matrix(1 2 3)">{PATH}</g>')),
    "svg transform to one point": (".svg", svg(f'<g transform="scale(0)">{PATH}</g>')),
    "svg transform to infinity": (".svg", svg(f'<g transform="{"scale(1e300)" * 3}">{PATH}</g>')),
    "svg use of nothing": (".svg", svg('<use href="#nothing"/>')),
    "svg use of another file": (".svg", svg('<use href="other.svg#a"/>')),
    "svg use of itself": (".svg", svg(f'<g id="a">{PATH}<use href="#a"/></g>')),
    "svg of groups nested too deeply": (".svg", svg("<g>" * DEEPEST + PATH + "</g>" * DEEPEST)),
    "svg of too many elements": (".svg", svg("<g/>" * MOST_ELEMENTS + PATH)),
    "svg of thousands of paths": (".svg", svg(PATH * 3000)),
    "svg entity bomb": (".svg", f"{BOMB}]><svg>&i;</svg>"),
    "svg external entity": (".svg", '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:' + '///etc/hostname">]><svg>&x;</svg>'),
    "svg undefined entity": (".svg", "<svg>&x;</svg>"),
    # CSV
    "csv empty": (".csv", ""),
    "csv blank": (".csv", "\n\n  \n"),
    "csv of a header only": (".csv", "x,y\n"),
    "csv of one column": (".csv", "1\n2\n3\n"),
    "csv of three columns": (".csv", "0,0,0\n1,0,0\n1,1,0\n"),
    "csv of frames": (".csv", "frame,time,vertex,x,y\n0,0.0,0,1.0,2.0\n"),
    "csv of words": (".csv", "to be\nor not\nto be\n"),
    "csv that breaks off": (".csv", "0,0\n1,0\n1"),
    "csv of mixed separators": (".csv", "0,0\n1;0\n1,1\n"),
    "csv of commas that separate and are decimal": (".csv", "0,5,1,5\n2,5,1,5\n2,5,3,5\n"),
    "csv of decimal commas and points": (".csv", "0,5;1.5\n2,5;1.5\n2,5;3.5\n"),
    "csv of thousands": (".csv", "1,000.5;2\n2,000.5;1\n3;3\n"),
    "csv of three columns with one name": (".csv", "x,b,c\n0,0,0\n1,0,0\n1,1,0\n"),
    "csv of two columns x": (".csv", "x,x,y\n0,0,0\n1,0,0\n1,1,0\n"),
    "csv of underscores": (".csv", "0,0\n1_0,0\n1,1\n"),
    "csv of NaN": (".csv", "0,0\nnan,0\n1,1\n"),
    "csv of infinity": (".csv", "0,0\ninf,0\n1,1\n"),
    "csv of huge numbers": (".csv", f"0,0\n{HUGE},0\n1,1\n"),
    "csv of tiny numbers": (".csv", "0,0\n1e-300,0\n1,1\n"),
    "csv of two points": (".csv", "0,0\n1,1\n"),
    "csv of one point many times": (".csv", "1,1\n" * 9),
    "csv in UTF-16": (".csv", "0,0\n1,0\n1,1\n".encode("utf-16")),
    "csv in Latin-1": (".csv", "é,è\n0,0\n1,0\n1,1\n".encode("latin-1")),
    "csv binary": (".csv", bytes(range(256)) * 4),
    "csv of null characters": (".csv", "\0" * 100),
    "csv of a long line": (".csv", "1" * 10**6),
    "csv of too many points": (".csv", "0,0\n1,1\n" * (MOST_POINTS // 2 + 1)),
    # JSON and GeoJSON
    "json empty": (".json", ""),
    "json truncated": (".json", "[[0, 0], [1, 0], [1"),
    "json of a word": (".json", "points"),
    "json null": (".json", "null"),
    "json number": (".json", "3"),
    "json string": (".json", '"[[0, 0], [1, 0], [1, 1]]"'),
    "json empty list": (".json", "[]"),
    "json empty object": (".json", "{}"),
    "json of other keys": (".json", '{"vertices": [[0, 0], [1, 0], [1, 1]]}'),
    "json of no curves": (".json", '{"curves": {}}'),
    "json of a list of curves": (".json", '{"curves": [[[0, 0], [1, 0], [1, 1]]]}'),
    "json of numbers": (".json", "[1, 2, 3, 4]"),
    "json of triples": (".json", "[[0, 0, 0], [1, 0, 0], [1, 1, 0]]"),
    "json ragged": (".json", "[[0, 0], [1], [1, 1]]"),
    "json of strings": (".json", '[["0", "0"], ["1", "0"], ["1", "1"]]'),
    "json of booleans": (".json", "[[true, 0], [1, 0], [1, 1]]"),
    "json of null coordinates": (".json", "[[0, null], [1, 0], [1, 1]]"),
    "json of NaN": (".json", "[[0, NaN], [1, 0], [1, 1]]"),
    "json of infinity": (".json", "[[0, 1e999], [1, 0], [1, 1]]"),
    "json of huge integers": (".json", f"[[0, {HUGE}], [1, 0], [1, 1]]"),
    "json of endless integers": (".json", f"[[0, {'9' * 5000}], [1, 0], [1, 1]]"),
    "json nested deeply": (".json", "[" * 100_000 + "]" * 100_000),
    "json nested deeply in a point": (".json", "[[0, " + "[" * 900 + "]" * 900 + "], [1, 0]]"),
    "json in UTF-16": (".json", "[[0, 0], [1, 0], [1, 1]]".encode("utf-16")),
    "json binary": (".json", bytes(range(256))),
    "geojson of a point": (".geojson", '{"type": "Point", "coordinates": [1, 2]}'),
    "geojson of points": (".geojson", '{"type": "MultiPoint", "coordinates": [[0, 0], [1, 0], [1, 1]]}'),
    "geojson of no features": (".geojson", '{"type": "FeatureCollection", "features": []}'),
    "geojson of odd features": (".geojson", '{"type": "FeatureCollection", "features": [1, 2]}'),
    "geojson without features": (".geojson", '{"type": "FeatureCollection"}'),
    "geojson feature without a geometry": (".geojson", '{"type": "Feature", "geometry": null}'),
    "geojson empty polygon": (".geojson", '{"type": "Polygon", "coordinates": []}'),
    "geojson polygon of one ring too few": (".geojson", '{"type": "Polygon", "coordinates": [[0, 0], [1, 0], [1, 1]]}'),
    "geojson line without coordinates": (".geojson", '{"type": "LineString"}'),
    "geojson of an odd type": (".geojson", '{"type": ["LineString"], "coordinates": []}'),
    # NumPy
    "npz empty": (".npz", b""),
    "npz truncated": (".npz", npz(points=np.array(SQUARE))[:-40]),
    "npz damaged": (".npz", npz(points=np.array(SQUARE)).replace(b"NUMPY", b"MUNPY")),
    "npz that is words": (".npz", "hello world"),
    "npz of no arrays": (".npz", _zip()),
    "npz of other files": (".npz", _zip(points="hello")),
    "npz that is npy": (".npz", npy(np.array(SQUARE))),
    "npz of objects": (".npz", npz(points=np.array([_Trap(), None], dtype=object))),
    "npz that is a pickle": (".npz", pickle.dumps(SQUARE)),
    "npz of strings": (".npz", npz(points=np.array([["0", "0"], ["1", "0"]]))),
    "npz of complex numbers": (".npz", npz(points=np.array([0, 1, 1j]))),
    "npz of booleans": (".npz", npz(points=np.eye(2, dtype=bool))),
    "npz of frames": (".npz", npz(frames=np.zeros((5, 4, 2)))),
    "npz of a wrong shape": (".npz", npz(points=np.zeros((2, 4)))),
    "npz of NaN": (".npz", npz(points=np.full((4, 2), np.nan))),
    "npz bomb": (".npz", _zip(points=b"\0" * (LARGEST_FILE + 1))),
    "npy empty array": (".npy", npy(np.zeros((0, 2)))),
    "npy flat": (".npy", npy(np.arange(8.0))),
    "npy of a number": (".npy", npy(np.float64(3))),
    "npy of records": (".npy", npy(np.zeros(4, dtype=[("x", float), ("y", float)]))),
    "npy of objects": (".npy", npy(np.array([_Trap()], dtype=object))),
    "npy truncated": (".npy", npy(np.array(SQUARE))[:-1]),
    "npy truncated in its header": (".npy", npy(np.array(SQUARE))[:20]),
    "npy that announces terabytes": (".npy", _header((10**12, 2))),
    "npy of a negative shape": (".npy", _header((-3, 2))),
    "npy of an odd shape": (".npy", _header("many")),
    "npy of a pickle": (".npy", pickle.dumps(SQUARE)),
    # Names
    "no suffix": ("", "0,0\n1,0\n1,1\n"),
    "unknown suffix": (".docx", "0,0\n1,0\n1,1\n"),
    "obj": (".obj", "v 0 0 0\n"),
}
