# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigorous diffraction by lamellar gratings, to judge the PHYSICAL model by.

Rigorous coupled-wave analysis: M. G. Moharam et al., "Formulation for stable and efficient
implementation of the rigorous coupled-wave analysis of binary gratings", J. Opt. Soc. Am. A 12,
1068 (1995); Fourier factorisation for TM after L. Li, "Use of Fourier series in the analysis of
discontinuous periodic structures", J. Opt. Soc. Am. A 13, 1870 (1996). Layers are joined from the
bottom up by the matrix that takes the tangential electric to the tangential magnetic field, in
which only decaying exponentials occur.

Lengths are in any one unit; fields vary as exp(-i omega t), so absorbers have Im n > 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Layer:
    """Ridges side by side with a filling, or with ``ridge == filling`` a film."""

    thickness: float
    ridge: complex
    filling: complex
    duty: float = 0.5


def _toeplitz(inside: complex, outside: complex, duty: float, size: int) -> np.ndarray:
    """Matrix of the Fourier coefficients of ``inside`` on the ridges, ``outside`` elsewhere."""
    order = np.subtract.outer(np.arange(size), np.arange(size))
    ridge = duty * np.sinc(order * duty)
    return outside * (order == 0) + (inside - outside) * ridge


def _decay(squared: np.ndarray) -> np.ndarray:
    """Square root for waves exp(-q z) that decay or travel downwards."""
    q = np.sqrt(squared.astype(complex))
    return np.where(q.real - q.imag < 0.0, -q, q)


def _modes(layer: Layer, kx: np.ndarray, tm: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Modes of a layer: fields, derived fields (columns), and their decay."""
    size = len(kx)
    if layer.ridge == layer.filling:
        q = _decay(kx**2 - layer.ridge**2)
        return np.eye(size), np.diag(q / layer.ridge**2 if tm else q), q
    epsilon = _toeplitz(layer.ridge**2, layer.filling**2, layer.duty, size)
    if not tm:
        squared, fields = np.linalg.eig(np.diag(kx**2) - epsilon)
        q = _decay(squared)
        return fields, fields * q, q
    inverse = _toeplitz(layer.ridge**-2, layer.filling**-2, layer.duty, size)
    inner = kx[:, None] * np.linalg.inv(epsilon) * kx - np.eye(size)
    squared, fields = np.linalg.eig(np.linalg.solve(inverse, inner))
    q = _decay(squared)
    return fields, inverse @ (fields * q), q


def efficiencies(
    layers: list[Layer],
    substrate: complex,
    period: float,
    wavelength: float,
    theta_deg: float,
    tm: bool,
    harmonics: int,
) -> dict[int, float]:
    """Reflected efficiency by order, for light in air in a plane across the wires.

    ``layers`` from the top. Order m leaves at sin(theta) + m wavelength / period on the mirror
    side. ``harmonics`` on either side of order 0.
    """
    order = np.arange(-harmonics, harmonics + 1)
    kx = np.sin(np.radians(theta_deg)) + order * wavelength / period
    _, derived, _ = _modes(Layer(0.0, substrate, substrate), kx, tm)
    down = -derived
    for layer in reversed(layers):
        fields, derived, q = _modes(layer, kx, tm)
        fade = np.exp(-2.0 * np.pi * layer.thickness / wavelength * q)
        up = np.linalg.solve(derived - down @ fields, (derived + down @ fields) * fade)
        up = fade[:, None] * up
        identity = np.eye(len(kx))
        down = derived @ (up - identity) @ np.linalg.inv(fields @ (identity + up))
    air = _decay(kx**2 - 1.0)
    incident = (order == 0).astype(complex)
    reflected = np.linalg.solve(np.diag(air) - down, (np.diag(air) + down) @ incident)
    return {
        int(m): float(abs(reflected[i]) ** 2 * air[i].imag / air[harmonics].imag)
        for i, m in enumerate(order)
        if abs(kx[i]) < 1.0
    }
