"""Intel RealSense depth cameras, through ``pyrealsense2``."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from etot_cli.errors import ServiceError
from etot_cli.execution.protocols import Frame
from etot_cli.specs.calibration import Calibration

SIZE, RATE = (640, 480), 30
"""A mode that all D400 cameras have, for colour and for depth [px, Hz]."""
WITHIN_MS = 1000
"""Longest wait for a picture [ms]."""


class RealSense:
    """Implements :class:`etot_cli.execution.protocols.Camera`.

    Args:
        calibration: where it stands.
    """

    def __init__(self, calibration: Calibration) -> None:
        self._calibration = calibration
        self._pipeline: Any = None
        self._align: Any = None
        self._scale = 0.001

    def connect(self) -> str:
        """Opens the camera, depth registered to colour.

        Raises:
            ServiceError: the package or the camera is missing.
        """
        if self._pipeline is not None:
            return "RealSense"
        try:
            module = importlib.import_module("pyrealsense2")
        except ImportError as error:
            raise ServiceError(
                "a RealSense camera needs the package pyrealsense2; install it with: "
                f"pip install 'etot[realsense]' ({error})"
            ) from None
        pipeline, config = module.pipeline(), module.config()
        if self._calibration.serial is not None:
            config.enable_device(self._calibration.serial)
        config.enable_stream(module.stream.color, *SIZE, module.format.rgb8, RATE)
        config.enable_stream(module.stream.depth, *SIZE, module.format.z16, RATE)
        try:
            profile = pipeline.start(config)
        except RuntimeError as error:
            raise ServiceError(f"no RealSense camera can be started: {error}") from error
        device = profile.get_device()
        self._scale = float(device.first_depth_sensor().get_depth_scale())
        self._align = module.align(module.stream.color)
        self._pipeline = pipeline
        name = device.get_info(module.camera_info.name)
        return f"{name} {device.get_info(module.camera_info.serial_number)}"

    def frame(self) -> Frame:
        """A picture taken now.

        Raises:
            ServiceError: none came in time.
        """
        if self._pipeline is None:
            raise ServiceError("the RealSense camera is not open")
        try:
            found = self._align.process(self._pipeline.wait_for_frames(WITHIN_MS))
        except RuntimeError as error:
            raise ServiceError(
                f"the RealSense camera gave no picture within {WITHIN_MS / 1000:g} s: {error}"
            ) from error
        color, depth = found.get_color_frame(), found.get_depth_frame()
        if not color or not depth:
            raise ServiceError("the RealSense camera gave a picture without colour or depth")
        return Frame(
            np.array(color.get_data(), dtype=np.uint8),
            np.array(depth.get_data(), dtype=np.float64) * self._scale,
            self._matrix(color),
            self._calibration.pose(),
            color.get_timestamp() * 1e-3,
        )

    def close(self) -> None:
        """Stops it."""
        if self._pipeline is not None:
            self._pipeline.stop()
            self._pipeline = None

    def _matrix(self, color: Any) -> Any:
        given = self._calibration.intrinsics
        if given is not None:
            return given.matrix()
        own = color.profile.as_video_stream_profile().get_intrinsics()
        return np.array([[own.fx, 0.0, own.ppx], [0.0, own.fy, own.ppy], [0.0, 0.0, 1.0]])
