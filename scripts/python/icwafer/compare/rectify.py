# SPDX-License-Identifier: GPL-2.0-or-later
"""Takes the perspective out of a picture of a flat die: four corners become a rectangle."""

from __future__ import annotations

import math

import numpy as np

from icwafer.errors import InputError

#: x, y in pixels from the top left corner of the image; the middle of the first pixel is (.5, .5).
Point = tuple[float, float]


def homography(corners: tuple[Point, Point, Point, Point]) -> np.ndarray:
    """The 3 x 3 matrix that takes the unit square to corners.

    corners: where (0, 0), (1, 0), (1, 1), (0, 1) go: in a picture the die's top left, top right,
    bottom right and bottom left.

    Raises InputError for corners that are no convex quadrilateral in this order.
    """
    points = np.asarray(corners, dtype=float)
    sides = np.roll(points, -1, axis=0) - points
    following = np.roll(sides, -1, axis=0)
    turns = sides[:, 0] * following[:, 1] - sides[:, 1] * following[:, 0]
    if not (turns > 0).all():
        raise InputError(
            "the corners are not in order around a convex shape; give top left, top right, "
            "bottom right, bottom left"
        )
    rows, right = [], []
    for (s, t), (x, y) in zip(((0, 0), (1, 0), (1, 1), (0, 1)), points):
        rows += [[s, t, 1, 0, 0, 0, -s * x, -t * x], [0, 0, 0, s, t, 1, -s * y, -t * y]]
        right += [x, y]
    return np.append(np.linalg.solve(rows, right), 1.0).reshape(3, 3)


def from_unit(corners: tuple[Point, Point, Point, Point], point: Point) -> Point:
    """Where a point of the die, in shares of its width and height, is in the picture."""
    x, y, w = homography(corners) @ (*point, 1.0)
    return float(x / w), float(y / w)


def natural_size(
    corners: tuple[Point, Point, Point, Point], longest: int = 512
) -> tuple[int, int]:
    """A size for the rectified image with the quadrilateral's mean width and height."""
    points = np.asarray(corners, dtype=float)
    top, right, bottom, left = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    width, height = (top + bottom) / 2, (left + right) / 2
    scale = longest / max(width, height)
    return max(1, round(width * scale)), max(1, round(height * scale))


def rectify(
    pixels: np.ndarray, corners: tuple[Point, Point, Point, Point], size: tuple[int, int]
) -> np.ndarray:
    """The quadrilateral as a rectangle of `size` (width, height), from linear light.

    Where the rectangle is coarser than the picture, each of its pixels is the mean of enough
    bilinear samples that nothing is skipped.

    Raises InputError when a corner lies outside the picture.
    """
    height, width = pixels.shape[:2]
    for x, y in corners:
        if not (0 <= x <= width and 0 <= y <= height):
            raise InputError(
                f"corner {x:g},{y:g} is outside the picture of {width}x{height}; "
                "count pixels from its top left corner"
            )
    matrix = homography(corners)
    points = np.asarray(corners, dtype=float)
    longest = (
        np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).reshape(2, 2).max(axis=0)
    )
    across, down = (max(1, math.ceil(longest[axis] / size[axis])) for axis in (0, 1))
    total = np.zeros((size[1], size[0], pixels.shape[2]))
    for i in range(across):
        for j in range(down):
            s = (np.arange(size[0]) + (i + 0.5) / across) / size[0]
            t = (np.arange(size[1]) + (j + 0.5) / down) / size[1]
            total += _at(pixels, matrix, s, t)
    return total / (across * down)


def _at(pixels: np.ndarray, matrix: np.ndarray, s: np.ndarray, t: np.ndarray) -> np.ndarray:
    unit = np.stack(np.broadcast_arrays(s[None, :], t[:, None], 1.0), axis=-1)
    x, y, w = np.moveaxis(unit @ matrix.T, -1, 0)
    return bilinear(pixels, x / w, y / w)


def bilinear(pixels: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Colours at positions in pixels; outside, those of the border."""
    height, width = pixels.shape[:2]
    x, y = np.clip(x - 0.5, 0, width - 1), np.clip(y - 0.5, 0, height - 1)
    column, row = x.astype(int), y.astype(int)
    next_column, next_row = np.minimum(column + 1, width - 1), np.minimum(row + 1, height - 1)
    right, below = (x - column)[..., None], (y - row)[..., None]
    above = (1 - right) * pixels[row, column] + right * pixels[row, next_column]
    under = (1 - right) * pixels[next_row, column] + right * pixels[next_row, next_column]
    return (1 - below) * above + below * under
