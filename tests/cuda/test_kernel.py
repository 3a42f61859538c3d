# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycles' CUDA kernel with the node compiles, as far as PTX: code for a virtual processor."""

from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

import kernel_usage
from kernel_usage import Usage

import host_edits
from icwafer import paths

#: What nvcc 13.0 reports, shortened to one kernel and one function that is not one.
REPORT = """\
ptxas info    : Function properties for _Z11bsdf_samplePK16KernelGlobalsGPUP10ShaderData
    0 bytes stack frame, 0 bytes spill stores, 4 bytes spill loads
ptxas info    : Compiling entry function 'kernel_gpu_shader_eval_displace' for 'sm_86'
ptxas info    : Function properties for kernel_gpu_shader_eval_displace
    8144 bytes stack frame, 8 bytes spill stores, 4 bytes spill loads
ptxas info    : Used 128 registers, used 0 barriers, 8144 bytes cumulative stack size
"""


class Report(unittest.TestCase):
    def test_reads_the_kernels_only(self) -> None:
        self.assertEqual(
            kernel_usage.usages(REPORT), {"shader_eval_displace": Usage(128, 8144, 8, 4)}
        )

    def test_names_what_grows(self) -> None:
        before = {"a": Usage(96, 100, 0, 0), "b": Usage(96, 100, 0, 0)}
        after = {"a": Usage(96, 120, 0, 0), "b": Usage(128, 1000, 40, 40)}
        self.assertEqual(kernel_usage.growth(before, before), [])
        self.assertEqual(
            kernel_usage.growth(before, after),
            [
                "b: 96 registers became 128",
                "b: a stack of 100 bytes became 1000",
                "b: 0 bytes of spills became 80",
            ],
        )
        self.assertIn("| b | 96 → 128 | 100 → 1000 |", kernel_usage.table(before, after))


@unittest.skipUnless(kernel_usage.nvcc(), "nvcc is missing")
@unittest.skipUnless(paths.host_source().is_dir(), "Blender's source is not there")
class Compiles(unittest.TestCase):
    def test_shading_of_surfaces(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder) / "host"
            kernel_usage.copy_host(paths.host_source(), tree)
            host_edits.apply(tree)
            ptx = Path(folder) / "shade_surface.ptx"
            try:
                kernel_usage.compile_kernels(tree, kernel_usage.SHADE_SURFACE, ptx)
            except subprocess.CalledProcessError as error:
                self.fail(error.stderr)
            text = ptx.read_text()
        self.assertIn(".entry shade_surface(", text)
        self.assertEqual(text.count(".entry "), 1)


if __name__ == "__main__":
    unittest.main()
