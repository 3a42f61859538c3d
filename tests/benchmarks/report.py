# SPDX-License-Identifier: GPL-2.0-or-later
"""Run bench_physical and print its ratios as Markdown tables; optionally plot cost by spacing.

    /usr/bin/python3 tests/benchmarks/report.py build/core/tests/benchmarks/bench_physical cost.svg
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Measurement:
    """CPU time of one call in nanoseconds, and what else the benchmark counts."""

    time_ns: float
    counters: dict[str, float]


def measure(program: Path) -> dict[str, Measurement]:
    """Results of all benchmarks of a program by name."""
    output = subprocess.run(
        [program, "--benchmark_format=json", "--benchmark_min_time=0.3"],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return {
        run["name"]: Measurement(run["cpu_time"], run) for run in json.loads(output)["benchmarks"]
    }


def family(results: dict[str, Measurement], name: str) -> dict[int, Measurement]:
    """Benchmarks ``name/argument:value...`` by the value of their argument."""
    found = {}
    for key, measurement in results.items():
        if key.startswith(name + "/"):
            argument = key[len(name) + 1 :].split("/")[0]
            found[int(argument.split(":")[1])] = measurement
    return found


def lobe_table(results: dict[str, Measurement]) -> str:
    """Evaluation against the sampled spectrum, by width of the lobe."""
    lines = [
        "| lobe width | evaluation | RMS | wavelengths for 0.5 % | near order only | all orders |",
        "|---|---|---|---|---|---|",
    ]
    near = family(results, "lobe_sampled_spectrum/near_order")
    every = family(results, "lobe_sampled_spectrum/all_orders")
    for width, own in family(results, "lobe_evaluation").items():
        lines.append(
            f"| {1e-3 * width:g} | {own.time_ns:.0f} ns | {100 * own.counters['rms']:.2f} % "
            f"| {near[width].counters['wavelengths']:.0f} "
            f"| {near[width].time_ns / own.time_ns:.1f} × "
            f"| {every[width].time_ns / own.time_ns:.1f} × |"
        )
    return "\n".join(lines)


def noise_table(results: dict[str, Measurement]) -> str:
    """Variance at equal time, relative to the model's own sampling."""
    lines = [
        "| coherence | cosine, lamp sampled too | cosine only |",
        "|---|---|---|",
    ]
    for coherence_um, own in family(results, "noise/own_and_lamp").items():
        cost = own.counters["variance"] * own.time_ns
        ratios = [
            family(results, name)[coherence_um].counters["variance"]
            * family(results, name)[coherence_um].time_ns
            / cost
            for name in ("noise/cosine_and_lamp", "noise/cosine")
        ]
        lines.append(f"| {coherence_um} µm | {ratios[0]:.0f} × | {ratios[1]:.0f} × |")
    return "\n".join(lines)


def spacing_costs(results: dict[str, Measurement]) -> dict[str, dict[int, float]]:
    """Cost by coherence and spacing in nm, relative to that at 1 µm with the first coherence."""
    costs = {
        f"{coherence_um} µm": family(results, f"spacing_evaluation/coherence_{coherence_um}_um")
        for coherence_um in (15, 60)
    }
    unit_ns = costs["15 µm"][1000].time_ns
    return {
        coherence: {nm: cost.time_ns / unit_ns for nm, cost in by_spacing.items()}
        for coherence, by_spacing in costs.items()
    }


def spacing_table(costs: dict[str, dict[int, float]]) -> str:
    """Cost by spacing, a column for each coherence."""
    lines = [
        f"| spacing | {' | '.join(f'coherence {name}' for name in costs)} |",
        f"|---|{'---|' * len(costs)}",
    ]
    for nm in next(iter(costs.values())):
        cells = " | ".join(f"{by_spacing[nm]:.2f}" for by_spacing in costs.values())
        lines.append(f"| {1e-3 * nm:g} µm | {cells} |")
    return "\n".join(lines)


def spacing_plot(costs: dict[str, dict[int, float]]) -> str:
    """SVG of cost over the logarithm of the spacing, a line for each coherence."""
    width, height, left, right, bottom, top = 640, 320, 60, 90, 50, 20
    highest = max(2.0, *(math.ceil(max(line.values())) for line in costs.values()))
    spacings = list(next(iter(costs.values())))
    low, high = math.log(min(spacings)), math.log(max(spacings))

    def place(spacing_nm: float, value: float) -> tuple[float, float]:
        x = left + (width - left - right) * (math.log(spacing_nm) - low) / (high - low)
        return x, height - bottom - (height - bottom - top) * value / highest

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        'font-family="sans-serif" font-size="13" fill="#333">',
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
    ]
    for value in range(int(highest) + 1):
        y = place(1000.0, value)[1]
        parts.append(f'<path d="M{left} {y:.1f}H{width - right}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{value}</text>')
    for spacing_nm in (200, 1000, 10000, 100000):
        x = place(spacing_nm, 0.0)[0]
        label = f"{1e-3 * spacing_nm:g} µm"
        parts.append(f'<text x="{x:.1f}" y="{height - 30}" text-anchor="middle">{label}</text>')
    for number, ((name, line), colour) in enumerate(zip(costs.items(), ("#b5522b", "#2b6cb5"))):
        points = [place(nm, value) for nm, value in line.items()]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        stroke = f'fill="none" stroke="{colour}" stroke-width="2.5"'
        parts.append(f'<polyline points="{path}" {stroke}/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in points]
        y = top + 20 + 18 * number
        parts.append(f'<text x="{width - right + 8}" y="{y}" fill="{colour}">W = {name}</text>')
    parts.append(
        f'<text x="{(left + width - right) / 2}" y="{height - 8}" text-anchor="middle">'
        "wire spacing; cost of one evaluation relative to that at 1 µm</text></svg>"
    )
    return "\n".join(parts) + "\n"


def main(arguments: list[str]) -> None:
    results = measure(Path(arguments[0]))
    costs = spacing_costs(results)
    print(lobe_table(results), noise_table(results), spacing_table(costs), sep="\n\n")
    if len(arguments) > 1:
        Path(arguments[1]).write_text(spacing_plot(costs), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
