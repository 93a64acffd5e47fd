"""Tables of points are read as spreadsheets write them, and refused where they could mean two things."""

import numpy as np
import pytest
from files import named
from hypothesis import given
from hypothesis import strategies as st
from strategies import exact_doubles

from tween.errors import FileError
from tween.io.formats.tables import read_csv

points = st.lists(st.tuples(exact_doubles, exact_doubles), min_size=1, max_size=6)


@given(points, st.sampled_from([",", ";", " ", "\t"]), st.sampled_from(["", "x{0}y\n", "# a remark\n\n"]))
def test_rows_of_csv_are_read_whatever_separates_them(rows, separator, head):
    text = head.format(separator) + "\n".join(f"{x!r}{separator}{y!r}" for x, y in rows)
    ((name, found),) = named(read_csv(text.encode()))
    assert name == ""
    assert np.array_equal(found, rows)


@given(points, st.data())
def test_a_row_of_csv_that_is_damaged_is_named(rows, data):
    lines = [f"{x!r},{y!r}" for x, y in [(0.0, 0.0), *rows]]
    i = data.draw(st.integers(1, len(rows)))
    lines[i] = data.draw(st.sampled_from(["1", "1,2,3", "1,x", "1,1_0", "1,0x1"]))
    with pytest.raises(FileError, match=rf"^line {i + 1} is .*expected two numbers"):
        read_csv("\n".join(lines).encode())


@pytest.mark.parametrize(
    "text",
    [
        "x,y\n1.5,0.5\n2.5,3.5\n",
        "y,x\n0.5,1.5\n3.5,2.5\n",
        "Y [mm];X [mm]\n0.5;1.5\n3.5;2.5\n",
        "x;y\n1,5;0,5\n2,5;3,5\n",
        "1,5;0,5\n2,5;3,5\n",
        "1,5\t0,5\n2,5\t3,5\n",
        '"x","y"\n"1.5","0.5"\n"2.5","3.5"\n',
        ",x,y\n0,1.5,0.5\n1,2.5,3.5\n",
        "index,y,x\n7,0.5,1.5\n9,3.5,2.5\n",
        "id;x;y\na;1,5;0,5\nb;2,5;3,5\n",
        "0,1.5,0.5\n1,2.5,3.5\n",
        "1 1.5 0.5\n2 2.5 3.5\n",
        "x_pos,y_pos\n1.5,0.5\n2.5,3.5\n",
        "easting,northing\n1.5,0.5\n2.5,3.5\n",
    ],
)
def test_one_curve_is_read_however_its_columns_stand_and_its_numbers_are_written(text):
    content = read_csv(text.encode())
    assert content.outlines[0].points.tolist() == [[1.5, 0.5], [2.5, 3.5]]
    assert content.unused == []


def test_columns_that_are_not_used_are_named():
    assert read_csv(b"x,y,z,comment\n0,1,2,a\n").unused == ["column 'z'", "column 'comment'"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0,5,1,5\n", "two numbers"),
        ("0.5;1,5\n2;3\n", "two numbers"),
        ("1,234.5;2\n", "two numbers"),
        ("0,1,2\n0,3,4\n", "two numbers"),
        ("x,b,c\n1,2,3\n", "one named x and one named y"),
        ("x,x,y\n1,2,3\n", "one named x and one named y"),
        ("x,y,z\n1,2\n", "3 fields with x and y"),
        ("frame,time,vertex,x,y\n0,0,0,1,1\n", "frames of a morph"),
    ],
)
def test_what_could_mean_two_things_is_refused(text, words):
    with pytest.raises(FileError, match=words):
        read_csv(text.encode())
