"""The displacement of depth against colour is found where few edges are seen, too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.world.capture import KINECT, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import others

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("use_masks", [True, False], ids=["given masks", "no masks"])
def test_displacement_and_desk_of_a_dark_scene(tmp_path: Path, use_masks: bool) -> None:
    """The desk's height depends on the displacement: a row is a millimetre."""
    picture = add_noise(render(others()["chest"]), KINECT, np.random.default_rng(0))
    write_capture(picture, tmp_path / "chest", scale=KINECT.scale)
    seen = calibrate(read_capture(tmp_path / "chest", use_masks=use_masks))
    assert np.abs(np.array(seen.shift) - KINECT.shift).max() < 1.5
    assert seen.desk_top == pytest.approx(0.10, abs=0.001)
