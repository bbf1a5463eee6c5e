"""What is left out on purpose: outside the workspace, or by name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from etot_cli.cli.app import run
from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.reconstruction.leaving_out import checked_names, outside
from etot_cli.reconstruction.masks.automatic import find_segments
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import Twin, reconstruct
from etot_cli.world.capture import Picture, write_capture

WITHOUT_MUG = Workspace(0.3, 0.7, -0.3, 0.1)


def positions(twin: Twin) -> dict[str, np.ndarray]:
    return {solid.name: solid.center for solid in twin.solids}


@pytest.fixture(scope="module")
def whole(picture: Picture, tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """Where everything is when nothing is left out."""
    folder = tmp_path_factory.mktemp("whole")
    write_capture(picture, folder)
    return positions(reconstruct(Options(capture=folder, settle=False)))


@pytest.mark.slow
def test_what_stands_outside_is_counted_and_leaves_the_rest_as_it_is(
    folder: Path, whole: dict[str, np.ndarray]
) -> None:
    twin = reconstruct(Options(capture=folder, settle=False, workspace=WITHOUT_MUG))
    assert set(positions(twin)) == {"crate", "marker", "ball"}
    assert twin.outside == 1
    assert [text for text in twin.warnings if "mug" in text or "no mask" in text] == []
    assert sum("1 thing(s) outside the workspace" in text for text in twin.warnings) == 1
    for name, center in positions(twin).items():
        assert np.linalg.norm(center - whole[name]) < 0.001, name
    (x, y), (width, depth) = (twin.document["desk"][key] for key in ("center", "size"))
    assert x + width / 2 < 0.705
    assert y + depth / 2 < 0.105


@pytest.mark.slow
def test_found_things_outside_are_left_out_whole(folder: Path) -> None:
    seen = calibrate(read_capture(folder, use_masks=False), workspace=WITHOUT_MUG)
    found = find_segments(seen)
    seen, kept, left = outside(seen, found, WITHOUT_MUG)
    mug = read_capture(folder).masks["mug"]
    (gone,) = left
    assert (gone.mask & mug).sum() > 0.9 * mug.sum()
    assert len(kept) == len(found) - 1
    assert not any((segment.mask & mug).sum() > 0.05 * mug.sum() for segment in kept)
    assert (seen.aside[0] == gone.mask).all()


def test_a_workspace_without_desk_says_so(folder: Path) -> None:
    with pytest.raises(SpecError, match=r"no desk is seen .* the workspace \(x -1 … -0.9, y -0.1"):
        calibrate(read_capture(folder), workspace=Workspace(-1.0, -0.9, -0.1, 0.1))


@pytest.mark.slow
def test_an_ignored_mask_is_neither_object_nor_desk_nor_missed(
    folder: Path, whole: dict[str, np.ndarray]
) -> None:
    twin = reconstruct(Options(capture=folder, settle=False, ignore=("mug",)))
    assert set(positions(twin)) == {"crate", "marker", "ball"}
    assert twin.ignored == ["mug"]
    assert not any("no mask" in text for text in twin.warnings)
    # Only the desk's plane, of which the mug's pixels are no part now, moves others at all.
    for name in ("crate", "marker"):
        assert np.linalg.norm(positions(twin)[name] - whole[name]) < 1e-6, name
    assert np.linalg.norm(positions(twin)["ball"] - whole["ball"]) < 0.001
    flat = read_capture(folder)
    rows = np.zeros(flat.depth.shape, dtype=bool)
    rows[300:] = True
    assert not (calibrate(flat, aside=[rows]).desk & rows).any()


@pytest.mark.slow
def test_a_found_thing_is_ignored_by_the_name_that_it_would_have(folder: Path) -> None:
    asked = Options(capture=folder, auto=True, settle=False, instruction="Put the ball in the mug.")
    first = reconstruct(asked)
    found = positions(first)
    carrier = next(solid for solid in first.solids if solid.support != "desk").support
    twin = reconstruct(replace(asked, ignore=(carrier,)))
    rest = positions(twin)
    assert len(found) - len(rest) == 2
    assert sum(f"stands on {carrier}, which is left out" in text for text in twin.warnings) == 1
    assert all(np.array_equal(rest[name], found[name]) for name in rest)


def test_an_unknown_name_is_an_error_with_the_nearest() -> None:
    known = ["white_mug", "red_mug", "can"]
    assert checked_names(["white mug"], known, "f") == {"white_mug"}
    with pytest.raises(SpecError, match=r"'whte_mug': nothing has this name; expected white_mug"):
        checked_names(["whte_mug"], known, "f")
    with pytest.raises(SpecError, match="expected can, red_mug, white_mug"):
        checked_names(["xyzzy"], known, "f")


@pytest.mark.parametrize(
    ("flag", "words"),
    [
        ("--workspace=0,1,0", "expected X0,X1,Y0,Y1"),
        ("--workspace=0,1,0,nan", "expected X0,X1,Y0,Y1"),
        ("--workspace=a,1,0,1", "expected X0,X1,Y0,Y1"),
        ("--workspace=0.5,0.2,0,1", "expected X0 < X1 and Y0 < Y1"),
        ("--workspace=200,700,-300,300", "expected metres, none beyond ±5"),
        ("--ignore=mugg", "nothing has this name; expected mug"),
        ("--material=mugg=wood", "--material 'mugg': nothing has this name; expected mug"),
    ],
)
def test_bad_values_are_one_error(
    flag: str, words: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["reconstruct", str(folder), flag, "--out", str(tmp_path / "out")]) == 2
    shown = capsys.readouterr()
    assert words in " ".join(shown.err.split())
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("flag", ["--ignore", "--material"])
def test_where_nothing_is_found_no_name_is_expected(flag: str) -> None:
    with pytest.raises(SpecError, match=f"expected no {flag}: nothing is found"):
        checked_names(["cup"], set(), "f", flag)
