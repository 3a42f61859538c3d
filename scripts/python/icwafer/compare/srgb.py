# SPDX-License-Identifier: GPL-2.0-or-later
"""sRGB, CIE XYZ, CIELAB: the colour arithmetic that the metrics share.

All functions take and return arrays of height x width x 3 (any leading shape works).
"""

from __future__ import annotations

import numpy as np

#: Linear Rec.709 with D65 to CIE XYZ (IEC 61966-2-1, from the primaries' chromaticities).
REC709_TO_XYZ = np.array(
    [
        [0.412390799, 0.357584339, 0.180480788],
        [0.212639006, 0.715168679, 0.072192315],
        [0.019330819, 0.119194780, 0.950532152],
    ]
)
XYZ_TO_REC709 = np.linalg.inv(REC709_TO_XYZ)
#: XYZ of (1, 1, 1).
WHITE_XYZ = REC709_TO_XYZ.sum(axis=1)
LUMINANCE = REC709_TO_XYZ[1]
_TO_SHARES = REC709_TO_XYZ / WHITE_XYZ[:, None]


def decode(encoded: np.ndarray) -> np.ndarray:
    """sRGB-encoded values to linear light (IEC 61966-2-1)."""
    above = ((np.maximum(encoded, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 0.04045, encoded / 12.92, above)


def encode(linear: np.ndarray) -> np.ndarray:
    """Linear light to sRGB-encoded values, the inverse of `decode`."""
    above = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, linear * 12.92, above)


def to_xyz(linear: np.ndarray) -> np.ndarray:
    """Linear Rec.709 to XYZ, as shares of the white point's; floats of any precision."""
    return linear @ _TO_SHARES.astype(linear.dtype).T


def from_xyz(xyz: np.ndarray) -> np.ndarray:
    """The inverse of `to_xyz`."""
    return xyz @ np.linalg.inv(_TO_SHARES).astype(xyz.dtype).T


def to_lab(linear: np.ndarray) -> np.ndarray:
    """Linear Rec.709 to CIELAB (CIE 15:2004, 8.2.1.1) with D65: L* 0 to 100."""
    xyz = to_xyz(linear)
    delta = 6 / 29
    root = np.where(
        xyz > delta**3, np.cbrt(np.maximum(xyz, 0.0)), xyz / (3 * delta**2) + 4 / 29
    )
    x, y, z = np.moveaxis(root, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)
