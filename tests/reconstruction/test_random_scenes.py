"""Desks that nobody arranged come back thing by thing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import reconstruct
from etot_cli.world.capture import KINECT, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.random_scenes import SHOWN, random_scene

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("seed", "noisy"), [(0, False), (1, True), (6, True)])
def test_every_thing_of_a_random_desk(seed: int, noisy: bool, tmp_path: Path) -> None:
    what = random_scene(seed)
    picture = render(what)
    if noisy:
        noise = add_noise(picture, KINECT, np.random.default_rng(seed))
        write_capture(noise, tmp_path, scale=KINECT.scale)
    else:
        write_capture(picture, tmp_path)
    twin = reconstruct(Options(capture=tmp_path, auto=True, settle=False))
    shown = {name: mask for name, mask in picture.masks.items() if mask.sum() >= SHOWN}
    assert len(shown) >= 4
    found = set()
    far, large = (0.008, 0.08) if noisy else (0.005, 0.04)
    for name, mask in shown.items():
        solid = max(twin.solids, key=lambda solid: int((solid.segment.mask & mask).sum()))
        true = picture.truth["objects"][name]
        found.add(solid.name)
        assert solid.kind == what.objects[name].kind, name
        assert np.linalg.norm(solid.center - true["position"]) < far, name
        assert np.sort(solid.size) == pytest.approx(np.sort(true["size"]), rel=large), name
    assert {solid.name for solid in twin.solids} == found
