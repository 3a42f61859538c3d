#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What Cycles' CUDA kernels take with and without the node: registers, stack, spills.

    kernel_usage.py [--all]

Compiles the kernel that shades surfaces (2 minutes), or with --all every kernel (8 minutes),
twice, from copies of the host's source tree, and prints a table for the README. The status is 1
when registers, stack or spills of any kernel grow by more than the node may take.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "scripts" / "python"), str(REPOSITORY / "plugin")]

import host_edits  # noqa: E402
from icwafer import paths  # noqa: E402

SHADE_SURFACE = Path(__file__).with_name("shade_surface.cu")
ALL_KERNELS = Path("kernel/device/cuda/kernel.cu")
#: An architecture that Cycles 3.4 knows and that nvcc 11.1 and later can compile for.
ARCHITECTURE = "sm_86"
#: How much a kernel's stack and its spills may grow, in bytes; registers may not grow at all. The
#: PHYSICAL model takes 656 of stack, 9 % of what shading a surface takes without it.
ALLOWED_STACK, ALLOWED_SPILLS = 672, 64


@dataclass(frozen=True)
class Usage:
    """What one thread of a kernel takes, as ptxas reports it; sizes in bytes."""

    registers: int
    stack: int
    spill_stores: int
    spill_loads: int


def nvcc() -> str | None:
    """The compiler, on PATH or where Nvidia's installer puts it."""
    return shutil.which("nvcc") or shutil.which("nvcc", path="/usr/local/cuda/bin")


def copy_host(tree: Path, to: Path) -> None:
    """Copies of a host's tree what Cycles' kernels and host_edits need, edited or not."""
    names = {host_edits.VERSION_HEADER, *host_edits.load_edits(paths.HOST).edits}
    manifest = tree / host_edits.STATE_FOLDER / "manifest.json"
    if manifest.exists():
        names |= json.loads(manifest.read_text())["files"].keys()
        shutil.copytree(manifest.parent, to / host_edits.STATE_FOLDER)
    shutil.copytree(tree / "intern" / "cycles", to / "intern" / "cycles")
    for name in names:
        if (tree / name).exists() and not (to / name).exists():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(tree / name, to / name)


def compile_kernels(tree: Path, source: Path, product: Path) -> str:
    """Compiles as Cycles does, to PTX or a cubin by the product's suffix; returns what ptxas says.

    Raises `subprocess.CalledProcessError`, with the compiler's words in `stderr`."""
    cycles = tree / "intern" / "cycles"
    done = subprocess.run(
        [
            nvcc() or "nvcc",
            f"-arch={ARCHITECTURE}",
            f"--{product.suffix[1:]}",
            source,
            *("-I", cycles, "-I", cycles / "kernel" / "device" / "cuda"),
            *("--use_fast_math", "-m64", "-DCCL_NAMESPACE_BEGIN=", "-DCCL_NAMESPACE_END="),
            *("-DNVCC", "-Xptxas", "-v", "-o", product),
        ],
        cwd=cycles,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stderr


def usages(report: str) -> dict[str, Usage]:
    """The kernels of a report of `ptxas -v`, by name."""
    pattern = (
        r"Function properties for (\w+)\n"
        r" +(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads\n"
        r"ptxas info +: Used (\d+) registers"
    )
    return {
        name.removeprefix("kernel_gpu_"): Usage(int(registers), int(stack), int(stores), int(loads))
        for name, stack, stores, loads, registers in re.findall(pattern, report)
    }


def measure(source: Path) -> tuple[dict[str, Usage], dict[str, Usage]]:
    """The kernels of a source file without and with the node."""
    with tempfile.TemporaryDirectory() as folder:
        results = []
        for change in (host_edits.revert, host_edits.apply):
            tree = Path(folder) / change.__name__
            copy_host(paths.host_source(), tree)
            change(tree)
            results.append(usages(compile_kernels(tree, source, Path(folder) / "kernels.cubin")))
    return results[0], results[1]


def table(before: dict[str, Usage], after: dict[str, Usage]) -> str:
    """A Markdown table of the kernels, those that differ first."""
    lines = ["| kernel | registers | stack | spill stores | spill loads |", "|---|---|---|---|---|"]
    for name in sorted(before, key=lambda name: (before[name] == after[name], name)):
        cells = []
        for key in ("registers", "stack", "spill_stores", "spill_loads"):
            old, new = getattr(before[name], key), getattr(after[name], key)
            cells.append(f"{old}" if old == new else f"{old} → {new}")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def growth(before: dict[str, Usage], after: dict[str, Usage]) -> list[str]:
    """What grows more than it may, a line each."""
    problems = []
    for name, old in before.items():
        new = after[name]
        if new.registers > old.registers:
            problems.append(f"{name}: {old.registers} registers became {new.registers}")
        if new.stack > old.stack + ALLOWED_STACK:
            problems.append(f"{name}: a stack of {old.stack} bytes became {new.stack}")
        spilled = (old.spill_stores + old.spill_loads, new.spill_stores + new.spill_loads)
        if spilled[1] > spilled[0] + ALLOWED_SPILLS:
            problems.append(f"{name}: {spilled[0]} bytes of spills became {spilled[1]}")
    return problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--all", action="store_true", help="every kernel, not only surfaces")
    arguments = parser.parse_args()
    if not nvcc():
        raise SystemExit("kernel_usage: nvcc is missing; install Nvidia's CUDA toolkit")
    if not paths.host_source().is_dir():
        raise SystemExit("kernel_usage: no source of Blender; run scripts/icwafer build blender")
    try:
        before, after = measure(ALL_KERNELS if arguments.all else SHADE_SURFACE)
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"kernel_usage: nvcc failed:\n{error.stderr}") from None
    print(table(before, after))
    problems = growth(before, after)
    for problem in problems:
        print(f"kernel_usage: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
