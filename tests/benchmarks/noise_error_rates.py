# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures how often the noise-aware comparison is wrong, on real renders of a die.

    PYTHONPATH=scripts/python /usr/bin/python3 tests/benchmarks/noise_error_rates.py

Renders the picture "full" small with many seeds, as it is and with its wire spacing changed; then
prints, for one and for two renders of each scene, the share of pairs that are called different:
pairs of the same scene (to be below the level) and pairs of changed scenes (the power).
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / "python"), str(ROOT / "tests" / "blender")]

import host  # noqa: E402

from icwafer.compare import images, noise  # noqa: E402


def render(
    folder: Path, sets: dict[str, tuple[float, int]], size: tuple[int, int], samples: int
) -> dict[str, list[np.ndarray]]:
    """For each set its spacing scale and the number of renders; no seed comes twice."""
    seeds = itertools.count(1)
    renders = [
        {"seed": next(seeds), "spacing_scale": scale, "exr": str(folder / f"{name}-{i}.exr")}
        for name, (scale, count) in sets.items()
        for i in range(count)
    ]
    parameters = {
        "package": str(ROOT / "scripts" / "python"),
        "picture": "full",
        "size": size,
        "samples": samples,
        "renders": renders,
    }
    host.run_inside(host.built_blender(), "render_seeds", parameters, folder=folder, seconds=7200)
    return {
        name: [images.read(folder / f"{name}-{i}.exr").pixels for i in range(count)]
        for name, (_, count) in sets.items()
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=200, help="of scenes, each with 2 renders")
    parser.add_argument("--width", type=int, default=192)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument(
        "--changes", type=float, nargs="+", default=[0.001, 0.0025, 0.01], help="of the spacing"
    )
    arguments = parser.parse_args()
    size = (arguments.width, arguments.width * 9 // 16)
    pairs = arguments.pairs
    start = time.monotonic()
    sets = {
        f"changed {change:g}": (1 + change, 2 * min(pairs, 25)) for change in arguments.changes
    }
    others = render(
        host.fresh_folder("noise_error_rates"),
        sets | {"same": (1.0, 4 * pairs)},
        size,
        arguments.samples,
    )
    same = others.pop("same")
    print(f"{size[0]}x{size[1]}, {arguments.samples} samples, "
          f"rendered in {time.monotonic() - start:.0f} s")  # fmt: skip
    for count in (1, 2):
        groups = [same[i : i + count] for i in range(0, 2 * pairs * count, count)]
        report(f"same scene, {count} render(s) each", zip(groups[::2], groups[1::2]))
        for name, renders in others.items():
            theirs = [renders[i : i + count] for i in range(0, len(renders), count)]
            report(f"{name}, {count} render(s) each", zip(groups, theirs))


def report(title: str, pairs) -> None:
    found = [noise.compare(a, b) for a, b in pairs]
    rejected = sum(result.different for result in found)
    p = sorted(result.p for result in found)
    print(f"{title}: {rejected} of {len(found)} called different; "
          f"p median {p[len(p) // 2]:.3g}, least {p[0]:.3g}; "
          f"rms {found[0].rms:.3g}, beyond noise {found[0].rms_beyond}")  # fmt: skip


if __name__ == "__main__":
    main()
