"""The README: its code runs, its links lead somewhere, its commands exist."""

import re
from pathlib import Path

import pandas as pd
import pytest

from tween.app.command_line.main import main

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
LINKS = sorted(set(re.findall(r"\]\(([^)#:]+)\)", README)))
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def test_there_are_links_and_code() -> None:
    assert len(LINKS) >= 5
    assert BLOCKS


@pytest.mark.parametrize("link", LINKS)
def test_every_link_leads_to_a_file(link: str) -> None:
    assert (ROOT / link).exists()


@pytest.mark.parametrize("block", BLOCKS)
def test_the_code_runs(block: str, capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(block, "README.md", "exec"), {})
    assert capsys.readouterr().out


def test_the_command_lines_make_the_files_that_they_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    lines = [line.partition("#")[0].split() for line in README.splitlines() if line.startswith("tween ")]
    assert len(lines) == 3
    for words in lines:
        assert main(words[1:]) == 0
        assert Path(words[-1]).stat().st_size > 0


@pytest.mark.parametrize("command", sorted(set(re.findall(r"\bmake ([a-z]+)", README))))
def test_every_command_is_in_the_makefile(command: str) -> None:
    assert re.search(rf"^{command}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("module", sorted(set(re.findall(r"experiments/([\w/]+)\.py", README))))
def test_every_study_that_is_named_exists(module: str) -> None:
    assert (ROOT / "experiments" / f"{module}.py").exists()


# The numbers


def result(name: str) -> pd.DataFrame:
    return pd.read_csv(ROOT / "results" / f"{name}.csv", keep_default_na=False)


def words() -> str:
    return re.sub(r"\s+", " ", README)


def test_the_verdicts_are_counted_as_in_the_table() -> None:
    ledger = result("claims")
    claims, questions = (ledger[ledger["kind"] == kind] for kind in ("claim", "open question"))
    verdict, printed = claims["verdict"].value_counts(), claims["as_printed"].value_counts()
    held, conditional, unseen, failed = (
        verdict[v] for v in ("holds", "holds under a condition", "no difference seen", "fails")
    )
    told = f"{held} hold, {conditional} hold under a condition, {failed} fail, and for {unseen} no difference is seen"
    assert told in words()
    assert f"as printed {printed['holds']} hold and {len(claims) - printed['holds']} do not" in words()
    assert "Thirty-nine claims" in README and verdict.sum() == 39
    assert sorted(questions["verdict"]) == ["holds", "holds", "holds under a condition"]
    assert "three open questions are judged alike: two hold, one holds under a condition" in words()


def test_what_the_measures_go_with_is_told_as_it_is() -> None:
    rho = result("quality").set_index(["scope", "measure", "quality"])["rho"].astype(float)
    pair, curve = "methods of one pair", "triangulations of one curve"
    assert f"goes with short paths (rank correlation {rho[pair, 'AR_1e-4', 'path_length']:.2f})" in words()
    assert f"with more frames that bound no disk ({rho[pair, 'AR_1e-4', 'invalid']:.2f})" in words()
    assert f"a measure of swelling ({rho[curve, 'Var', 'swelling']:.2f})" in words()
    assert f"blind to distortion ({rho[curve, 'Var', 'energy']:.2f})" in words()


def test_no_pair_morphed_as_printed_has_a_bad_frame_as_told() -> None:
    printed = result("matching").query("method == 'paper'")
    assert (printed["disks"] == 61).all()
    assert f"None of our {len(printed)} pairs of curves, morphed as printed, has a frame that bounds no disk" in words()


def test_the_frames_of_the_guarantee_are_those_of_the_study() -> None:
    study = result("guarantee_summary")
    guaranteed = study[study["guarantee"]]
    assert guaranteed["frames_failed"].sum() == 0
    assert f"no frame of {guaranteed['frames'].sum():,} fails" in words()
    (each,) = guaranteed.groupby("path")["morphs"].sum().unique()
    assert f"({each} morphs along each of five paths)" in words() and guaranteed["path"].nunique() == 5
    plain = study[(study["kind"] == "random disk") & ~study["guarantee"]].set_index("path")
    broken = plain["morphs"] - plain["valid"]
    told = f"{broken['linear']} (linear) and {broken['slide']} (slide) of {plain['morphs']['slide']} random disks"
    assert told in words()


def test_what_remeshing_gains_is_told_as_the_grid_has_it() -> None:
    rows = pd.read_csv(ROOT / "results" / "grid_disk.csv").query("n == 96 and frames == 100")
    shapes = pd.read_csv(ROOT / "results" / "grid_shapes.csv").query("n == 96").set_index("curve")
    slide = rows.query("path == 'slide' and pace == 'time'")
    rank = slide.pivot(index="curve", columns="triangulation", values="AR_1e-9")
    factor = rank["uniform"] / rank["remeshed"]
    fewer = factor[shapes["slides_remeshed"] < shapes["slides_uniform"]]
    assert (fewer > 1).all()
    told = f"On {len(fewer)} of {len(factor)} curves, most of them fat with lobes, remeshing leaves fewer of these"
    assert f"{told}, and AR at 1e-9 is smaller on all {len(fewer)}, up to {fewer.max():.1f} times" in words()
    assert (shapes["kind"][fewer.index] == "star").mean() > 0.5
    larger = []
    for _, some in rows.groupby(["path", "pace"]):
        variance = some.pivot(index="curve", columns="triangulation", values="Var")
        larger.append((variance["remeshed"] > variance["uniform"]).sum())
    told = f"Var is larger remeshed on {min(larger)} to {max(larger)} of {len(variance)} curves, by path and pace"
    assert len(larger) == 4 and told in words()


def test_the_pairs_without_flips_are_counted() -> None:
    pairs = result("pairs").drop_duplicates(["source", "target"])
    assert f"{(pairs['common'] != 'none').sum()} of {len(pairs)} pairs" in words()


def test_the_figures_of_matching_are_those_of_the_study() -> None:
    study = result("matching")
    matched = study[study["method"] == "matched"]
    assert (len(matched), matched["flips"].astype(float).sum(), matched["guaranteed"].min()) == (561, 0, 1)
    assert (matched["disks"] == 61).all()
    medians = study.groupby("method")[["AR_1e-4", "Var", "swelling"]].median()
    printed, ours, matched = (medians.loc[name] for name in ("paper", "paper_guaranteed", "matched"))
    three = (printed, ours, matched)
    assert "AR at 1e-4 {:.0f}, {:.0f} and {:.0f}".format(*(m["AR_1e-4"] for m in three)) in words()
    variances = [f"{m['Var']:.1e}".replace("e-0", "e-") for m in three]
    assert "Var {}, {} and {}".format(*variances) in words()
    assert "larger end {:.1f}, {:.0f} and {:.0f}".format(*(m["swelling"] for m in three)) in words()


def test_the_central_root_under_steady_placement_is_that_of_the_study() -> None:
    row = result("root_steady_summary").query("path == 'slide' and measure == 'Var'").iloc[0]
    assert f"on {row['below_median']} of {row['curves']} curves" in words()
