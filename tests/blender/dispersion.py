# SPDX-License-Identifier: GPL-2.0-or-later
"""Where a grating's colours have to appear in a picture, from geometry and the CIE's data alone.

A lamp, small and bright, hangs over the plane z = 0, and a camera looks at it. For each pixel the
directions from the plane's point to the lamp and to the camera give u = (w_i + w_o) . nu, nu the
direction across the wires in the plane; light of wavelength lambda has its order m at
u = m lambda / d (DESIGN, "exact (conical) grating law"). What the pixel shows is then the working
space's sensitivity at those wavelengths. Nothing here is taken from the code under test.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import host
import numpy as np

CIE1931 = host.REPOSITORY / "shaders" / "icwafer" / "data" / "cie1931_2deg_1nm.csv"

# IEC 61966-2-1, CIE XYZ to linear Rec. 709.
XYZ_TO_REC709 = np.array(
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
)

# The orders that reach into the bands of the orders whose peaks are looked for, and some more.
ORDERS = range(-5, 6)

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Mount:
    """A grating, a lamp and a camera; lengths in metres, square pictures.

    The object is turned by `turn_deg` about its normal, and the wires by `direction_deg` against
    the object.
    `view` is the picture's width in metres for an orthographic camera, and for a perspective one
    the width of what it sees at a distance of 1 m.
    """

    name: str
    spacing_nm: float
    direction_deg: float
    lamp: Vector
    camera: Vector
    target: Vector = (0.0, 0.0, 0.0)
    turn_deg: float = 0.0
    perspective: bool = False
    view: float = 2.2
    lobe_width: float = 0.004
    size_px: int = 320


def camera_axes(mount: Mount) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vectors to the right and to the top of the picture, and forward."""
    forward = np.subtract(mount.target, mount.camera)
    forward /= np.linalg.norm(forward)
    # A camera that looks straight down has the world's y axis at its top.
    top = np.array([0.0, 1.0, 0.0]) if abs(forward[2]) > 0.999 else np.array([0.0, 0.0, 1.0])
    right = np.cross(forward, top)
    right /= np.linalg.norm(right)
    return right, np.cross(right, forward), forward


def points_on_plane(mount: Mount, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, ...]:
    """The plane's points seen at picture positions, and unit vectors from them to the eye.

    Positions are in pixels, row 0 at the top, pixel centres at integers.
    """
    right, up, forward = camera_axes(mount)
    across = ((column + 0.5) / mount.size_px - 0.5) * mount.view
    above = (0.5 - (row + 0.5) / mount.size_px) * mount.view
    offset = across[..., None] * right + above[..., None] * up
    if mount.perspective:
        origin = np.broadcast_to(mount.camera, offset.shape)
        ray = forward + offset
    else:
        origin = mount.camera + offset
        ray = np.broadcast_to(forward, offset.shape)
    ray = ray / np.linalg.norm(ray, axis=-1, keepdims=True)
    distance = -origin[..., 2] / ray[..., 2]
    return origin + distance[..., None] * ray, -ray


def deflection(mount: Mount, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, ...]:
    """u, v and the lamp's irradiance (up to a factor) at picture positions."""
    point, to_eye = points_on_plane(mount, column, row)
    to_lamp = mount.lamp - point
    distance = np.linalg.norm(to_lamp, axis=-1)
    to_lamp /= distance[..., None]
    angle = np.radians(mount.turn_deg + mount.direction_deg)
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    across = np.array([-np.sin(angle), np.cos(angle), 0.0])
    q = to_lamp + to_eye
    return q @ across, q @ along, to_lamp[..., 2] / distance**2


@cache
def sensitivities() -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths in nm, and the Rec. 709 sensitivity of red, green and blue per nm (n x 3).

    Each channel has the integral 1. Wavelengths are moved towards the neutral of their luminance
    until no channel is negative (DESIGN, "Colour").
    """
    wavelength_nm, *xyz = np.loadtxt(CIE1931, delimiter=",", skiprows=1).T
    rgb = np.stack(xyz, axis=1) @ XYZ_TO_REC709.T
    luminance_of_rgb = np.linalg.inv(XYZ_TO_REC709)[1] * rgb.sum(axis=0)
    rgb /= rgb.sum(axis=0)
    luminance = (rgb @ luminance_of_rgb / luminance_of_rgb.sum())[:, None]
    lowest = rgb.min(axis=1, keepdims=True)
    chroma = np.where(lowest < 0.0, luminance / (luminance - lowest), 1.0)
    mapped = luminance + chroma * (rgb - luminance)
    return wavelength_nm, mapped / mapped.sum(axis=0)


def reflectance(mount: Mount, u: np.ndarray) -> np.ndarray:
    """The grating's BRDF for equal-energy light at deflections u, up to a factor: n x 3.

    f = integral of S(lambda) (lambda / d) sum_m Gaussian(u - m lambda / d) d lambda, the CS348B
    model's f_IB with both other effects off (DESIGN, "The two models").
    """
    wavelength_nm, sensitivity = sensitivities()
    step = wavelength_nm / mount.spacing_nm
    lobes = np.zeros((u.size, step.size))
    for order in ORDERS:
        lobes += np.exp(-0.5 * ((u[:, None] - order * step) / mount.lobe_width) ** 2)
    return (lobes * step) @ sensitivity


@cache
def picture(mount: Mount) -> np.ndarray:
    """What Cycles should render, up to a factor and up to order 5: size x size x 3."""
    row, column = np.mgrid[: mount.size_px, : mount.size_px].astype(float)
    u, _, irradiance = deflection(mount, column, row)
    # It depends on u alone: computed where needed it would take minutes.
    grid = np.arange(u.min(), u.max() + 0.01, 0.5 * mount.lobe_width)
    table = reflectance(mount, grid)
    channels = [np.interp(u, grid, channel) for channel in table.T]
    return np.stack(channels, axis=-1) * irradiance[..., None]


# The lines on which peaks are looked for: across the wires, and beside that, where the direction
# of the wires shows.
LINES_V = (-0.25, 0.0, 0.25)


@dataclass(frozen=True)
class Peak:
    """The middle of a channel's band in one order, on a line of constant v in a picture."""

    channel: str
    order: int
    v: float
    column: float
    row: float


@cache
def dispersion_line(mount: Mount, v: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Picture positions of deflection v, about a pixel apart or closer: columns, rows, u.

    Empty when the place with u = 0 on it is outside the picture.
    """
    centre = _solve(mount, 0.0, v, np.full(2, mount.size_px / 2.0))
    if not _inside(mount, centre):
        return np.empty(0), np.empty(0), np.empty(0)
    sides = []
    for sign in (-1.0, 1.0):
        side = [centre]
        # Lamps are about a metre away, so this is about a pixel near the mirror direction.
        step = sign * mount.view / mount.size_px / float(np.linalg.norm(mount.camera))
        while _inside(mount, side[-1]):
            side.append(_solve(mount, len(side) * step, v, side[-1]))
        sides.append(side[:-1])
    line = np.array(sides[0][:0:-1] + sides[1])
    u, v_there, _ = deflection(mount, line[:, 0], line[:, 1])
    assert np.abs(v_there - v).max() < 1e-9 and np.all(np.diff(u) > 0)
    return line[:, 0], line[:, 1], u


def _inside(mount: Mount, position: np.ndarray) -> bool:
    return bool(np.all(position > 2.0) and np.all(position < mount.size_px - 3.0))


def _solve(mount: Mount, u: float, v: float, start: np.ndarray) -> np.ndarray:
    """The picture position of deflection (u, v), by Newton's method from a position near it."""
    position = start.astype(float)
    for _ in range(20):
        around = position + np.array([[0.0, 0.0], [1e-4, 0.0], [0.0, 1e-4]])
        u_there, v_there, _ = deflection(mount, around[:, 0], around[:, 1])
        value = np.array([u_there[0] - u, v_there[0] - v])
        if np.abs(value).max() < 1e-11:
            break
        slope = np.array([u_there[1:] - u_there[0], v_there[1:] - v_there[0]]) / 1e-4
        position = position - np.linalg.solve(slope, value)
    return position


def peaks(mount: Mount, pixels: np.ndarray) -> list[Peak]:
    """The peaks of orders -2, -1, 1 and 2 in a picture, as far as their bands are inside it."""
    found = []
    for v in LINES_V:
        column, row, u = dispersion_line(mount, v)
        for order in (-2, -1, 1, 2):
            # Where all wavelengths of this order are that are not the next order's too.
            first, last = sorted(
                order * wavelength / mount.spacing_nm for wavelength in (420, 690)
            )
            if not u.size or first < u[0] or last > u[-1]:
                continue
            band = (u > first) & (u < last)
            for c, channel in enumerate(("red", "green", "blue")):
                profile = _bilinear(pixels[..., c], column[band], row[band])
                middle = _middle_of_peak(profile)
                place = [
                    float(np.interp(middle, np.arange(profile.size), axis[band]))
                    for axis in (column, row)
                ]
                found.append(Peak(channel, order, v, *place))
    return found


def _middle_of_peak(profile: np.ndarray) -> float:
    """Where the highest peak of a profile is balanced, above half of its height: an index."""
    top = int(np.argmax(profile))
    above = profile - 0.5 * profile[top]
    low = np.flatnonzero(above <= 0.0)
    first = low[low < top].max(initial=-1) + 1
    last = low[low > top].min(initial=profile.size)
    return float(np.average(np.arange(first, last), weights=above[first:last]))


def _bilinear(channel: np.ndarray, column: np.ndarray, row: np.ndarray) -> np.ndarray:
    x, y = column.astype(int), row.astype(int)
    s, t = column - x, row - y
    above = (1.0 - s) * channel[y, x] + s * channel[y, x + 1]
    below = (1.0 - s) * channel[y + 1, x] + s * channel[y + 1, x + 1]
    return (1.0 - t) * above + t * below
