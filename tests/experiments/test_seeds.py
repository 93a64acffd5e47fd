"""Searches over seeds go on where they were interrupted."""

from experiments.seeds import collected


def test_what_stands_in_the_file_is_not_done_again(tmp_path) -> None:
    out, asked = tmp_path / "rows.jsonl", []

    def rows_of(seed):
        asked.append(seed)
        return [{"seed": seed, "side": side} for side in "ab"]

    first = collected(out, range(2), rows_of)
    assert first == [{"seed": seed, "side": side} for seed in range(2) for side in "ab"]
    assert collected(out, range(1, 4), rows_of)[:4] == first
    assert asked == [0, 1, 2, 3]
    assert len(collected(out, range(4), rows_of)) == 8 and len(asked) == 4
