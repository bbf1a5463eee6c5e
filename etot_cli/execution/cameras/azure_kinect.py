"""The Azure Kinect DK, through ``pyk4a``."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from etot_cli.errors import ServiceError
from etot_cli.execution.protocols import Frame
from etot_cli.specs.calibration import Calibration

WITHIN_MS = 1000
"""Longest wait for a picture [ms]; thirty frames of the camera."""
MILLIMETRE = 0.001


class AzureKinect:
    """Implements :class:`etot_cli.execution.protocols.Camera`.

    Args:
        calibration: where it stands.
    """

    def __init__(self, calibration: Calibration) -> None:
        self._calibration = calibration
        self._device: Any = None

    def connect(self) -> str:
        """Opens the first one, at 1280 × 720, depth registered to colour.

        Raises:
            ServiceError: the package or the camera is missing, or it is another one.
        """
        if self._device is not None:
            return "Azure Kinect"
        try:
            module = importlib.import_module("pyk4a")
        except ImportError as error:
            raise ServiceError(
                "the Azure Kinect needs the package pyk4a and Microsoft's k4a library; install the "
                f"package with: pip install 'etot[azure-kinect]' ({error})"
            ) from None
        config = module.Config(
            color_resolution=module.ColorResolution.RES_720P,
            depth_mode=module.DepthMode.NFOV_UNBINNED,
            synchronized_images_only=True,
        )
        device = module.PyK4A(config)
        try:
            device.start()
        except Exception as error:  # the package's exceptions share no base
            raise ServiceError(f"the Azure Kinect cannot be started: {error}") from error
        self._device = device
        serial = str(device.serial)
        wanted = self._calibration.serial
        if wanted is not None and serial != wanted:
            self.close()
            raise ServiceError(
                f"the calibration is of the camera {wanted}, and {serial} is connected"
            )
        return f"Azure Kinect {serial}"

    def frame(self) -> Frame:
        """A picture taken now.

        Raises:
            ServiceError: none came in time.
        """
        if self._device is None:
            raise ServiceError("the Azure Kinect is not open")
        try:
            found = self._device.get_capture(timeout=WITHIN_MS)
        except Exception as error:  # as above
            raise ServiceError(
                f"the Azure Kinect gave no picture within {WITHIN_MS / 1000:g} s: "
                f"{str(error) or type(error).__name__}"
            ) from error
        color, depth = found.color, found.transformed_depth
        if color is None or depth is None:
            raise ServiceError("the Azure Kinect gave a picture without colour or without depth")
        return Frame(
            np.ascontiguousarray(color[..., 2::-1]),
            np.asarray(depth, dtype=np.float64) * MILLIMETRE,
            self._matrix(),
            self._calibration.pose(),
            found.color_timestamp_usec * 1e-6,
        )

    def close(self) -> None:
        """Stops it."""
        if self._device is not None:
            self._device.stop()
            self._device = None

    def _matrix(self) -> Any:
        given = self._calibration.intrinsics
        if given is not None:
            return given.matrix()
        module = importlib.import_module("pyk4a")
        found = self._device.calibration.get_camera_matrix(module.CalibrationType.COLOR)
        return np.asarray(found, dtype=np.float64)
