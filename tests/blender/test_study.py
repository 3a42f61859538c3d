# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies rendered by the real Blender, small."""

from __future__ import annotations

import json
import os
import random
import resource
import shlex
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import host
import numpy as np
import OpenImageIO as oiio

from icwafer.dependencies import PACKAGE, imported

COMMAND = host.REPOSITORY / "scripts" / "icwafer"
SMALL = ("--set", "render.size=[64, 36]", "--set", "render.samples=4")
HEAD = 'version = 1\nname = "Test"\n[scene]\npicture = "full"\n'
SPACINGS = '[[axis]]\nname = "d"\nset = "node.Wire Spacing"\nvalues = [900, 1100]\n'
SEEDS = '[[axis]]\nname = "seed"\nset = "render.seed"\nvalues = [0, 1, 2, 3]\n'

MAKE_BLEND = """
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_plane_add(size=4)
material = bpy.data.materials.new("Wafer"); material.use_nodes = True
tree = material.node_tree; tree.nodes.clear()
node = tree.nodes.new("ShaderNodeBsdfICWafer"); node.model = "CS348B"
output = tree.nodes.new("ShaderNodeOutputMaterial")
tree.links.new(node.outputs[0], output.inputs["Surface"])
value = tree.nodes.new("ShaderNodeValue"); value.outputs[0].default_value = 700
tree.links.new(value.outputs[0], node.inputs["Wire Spacing"])
bpy.context.object.data.materials.append(material)
bpy.ops.object.light_add(type="POINT", location=(0, -2, 3)); bpy.context.object.name = "Lamp"
bpy.context.object.data.energy = 500
bpy.ops.object.camera_add(location=(0, 0, 6)); scene.camera = bpy.context.object
scene.use_nodes = True
files = scene.node_tree.nodes.new("CompositorNodeOutputFile"); files.base_path = "FOLDER/compositor"
layers = scene.node_tree.nodes.new("CompositorNodeRLayers")
composite = scene.node_tree.nodes.new("CompositorNodeComposite")
for node in (files, composite):
    scene.node_tree.links.new(layers.outputs[0], node.inputs[0])
text = bpy.data.texts.new("evil.py"); text.use_module = True
text.write("open('FOLDER/evil', 'w').write('x')")
scene["driven"] = 0.0
driver = scene.driver_add('["driven"]').driver
driver.expression = "len(str(__import__('os').mkdir('FOLDER/driven')))"
bpy.ops.wm.save_as_mainfile(filepath="FOLDER/scene.blend")
"""


def read(path: Path) -> np.ndarray:
    """(height, width, 3) float32."""
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., :3]


def metadata(path: Path) -> dict[str, str]:
    found = oiio.ImageInput.open(str(path)).spec().extra_attribs
    return {a.name: a.value for a in found if a.name.startswith("icwafer:")}


def images(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("image.*")}


class StudyCase(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.environment = {**os.environ, "ICWAFER_BLENDER": str(host.built_blender())}

    def study(self, text: str) -> Path:
        path = self.folder / "study.toml"
        path.write_text(text)
        return path

    def start(self, study: Path, output: str, *arguments: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [COMMAND, "render", study, "-o", self.folder / output, *arguments],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def render(self, study: Path, output: str, *arguments: str, status: int = 0) -> str:
        with self.start(study, output, *arguments) as process:
            out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, status, out + err)
        return out + err


class RenderTest(StudyCase):
    def test_one_worker_or_many_the_pixels_are_the_same(self) -> None:
        """The order of jobs in a worker does not matter either: the axes are exchanged."""
        self.render(self.study(HEAD + SPACINGS + SEEDS), "one", *SMALL)
        self.render(self.study(HEAD + SPACINGS + SEEDS), "two", *SMALL, "--jobs", "2")
        self.render(self.study(HEAD + SEEDS + SPACINGS), "turned", *SMALL)
        only = ("--only", "d-900_seed-3", "--only", "d-1100_seed-0", "--isolate")
        self.render(self.study(HEAD + SPACINGS + SEEDS), "alone", *SMALL, *only)
        for d in (900, 1100):
            for seed in range(4):
                first = self.folder / f"one/jobs/d-{d}_seed-{seed}"
                others = [self.folder / f"two/jobs/d-{d}_seed-{seed}",
                          self.folder / f"turned/jobs/seed-{seed}_d-{d}",
                          self.folder / f"alone/jobs/d-{d}_seed-{seed}"]  # fmt: skip
                for other in others:
                    if other.exists():
                        for name in ("image.exr", "image.png"):
                            np.testing.assert_array_equal(read(first / name), read(other / name))
        self.assertEqual(len(list((self.folder / "alone/jobs").iterdir())), 2)
        pixels = {str(p): read(p).tobytes() for p in (self.folder / "one").rglob("image.exr")}
        self.assertEqual(len(set(pixels.values())), 8, "some jobs gave the same picture")

    def test_an_exr_knows_how_to_be_rendered_again(self) -> None:
        study = self.study(HEAD + SPACINGS)
        self.render(study, "out", *SMALL)
        original = self.folder / "out/jobs/d-900/image.exr"
        noted = metadata(original)
        self.assertEqual(noted["icwafer:study"], "Test")
        self.assertEqual(json.loads(noted["icwafer:settings"]), {"d": 900})
        self.assertEqual(noted["icwafer:seed"], "0")
        self.assertEqual(
            noted["icwafer:command"],
            shlex.join([
                "scripts/icwafer", "render", str(study), "-o", f"{self.folder}/out", *SMALL,
                "--only", "d-900",
            ]),
        )  # fmt: skip
        self.assertEqual(len(noted["icwafer:node_build"]), 64)
        self.assertIn("blender", json.loads(noted["icwafer:versions"]))
        study.unlink()
        self.render(original, "again")
        again = self.folder / "again/jobs/d-900/image.exr"
        np.testing.assert_array_equal(read(original), read(again))
        self.assertEqual(metadata(again)["icwafer:key"], noted["icwafer:key"])

    def test_lights_surroundings_and_view(self) -> None:
        cases = {
            "as it is": "",
            "area": '[[axis.case.scene.lights]]\nkind = "AREA"\nposition_mm = [0, -9, 20]\n'
            "power_w = 30000\n",
            "sky": "scene.environment = {strength = 1}\n",
            "standard": 'scene.view = {transform = "Standard", look = "None"}\n',
            "plain": 'scene.node = {"Wire Spacing" = 1000, Color = [1, 0, 0]}\n',
        }
        text = "".join(f'[[axis.case]]\nname = "{n}"\n{t}' for n, t in cases.items())
        self.render(self.study(HEAD + '[[axis]]\nname = "c"\n' + text), "out", *SMALL)
        linear, shown = (
            {p.parent.name: read(p) for p in (self.folder / "out").rglob(f"image.{ending}")}
            for ending in ("exr", "png")
        )
        self.assertEqual(len({a.tobytes() for a in shown.values()}), 5)
        np.testing.assert_array_equal(linear["c-as-it-is"], linear["c-standard"])
        self.assertGreater(linear["c-sky"][0, 0, 0], 0.9)
        self.assertEqual(linear["c-as-it-is"][0, 0, 0], 0.0)
        self.assertEqual(linear["c-plain"][..., 1:].max(), 0.0)
        facts = json.loads((self.folder / "out/jobs/c-standard/job.json").read_text())
        self.assertEqual(facts["view_transform"], "Standard")

    def test_light_that_is_taken_over_is_the_light_that_would_be_rendered(self) -> None:
        """Two views swap their names, so that each job's light lies in the other's folder."""
        case = '[[axis.case]]\nname = "{}"\nscene = {{ view.gamma = {}, render.seed = {} }}\n'
        head = HEAD + '[[axis]]\nname = "c"\n'
        first = self.study(head + case.format("a", 1, 1) + case.format("b", 1, 2))
        self.render(first, "out", *SMALL)
        swapped = self.study(head + case.format("a", 2, 2) + case.format("b", 2, 1))
        self.render(swapped, "out", *SMALL)
        self.render(swapped, "alone", *SMALL, "--isolate")
        for job in ("c-a", "c-b"):
            for name in ("image.exr", "image.png"):
                taken, rendered = (
                    self.folder / f"{folder}/jobs/{job}/{name}" for folder in ("out", "alone")
                )
                np.testing.assert_array_equal(read(taken), read(rendered))
            self.assertEqual(metadata(taken.with_suffix(".exr"))["icwafer:job"], job)
        facts = json.loads((self.folder / "out/jobs/c-a/job.json").read_text())
        self.assertFalse(facts["rendered"])

    def test_what_this_blender_has_not_is_refused(self) -> None:
        for line, words in (
            ('view.transform = "Filmc"', "view.transform is not possible here: "),
            ('view.look = "Nice"', "view.look is not possible here: "),
        ):
            said = self.render(self.study(f"{HEAD}{line}\n"), "out", status=1)
            self.assertIn(f"study.toml:5: {words}", said)
            self.assertEqual(said.count("\n"), 1, said)

    def test_the_studies_of_the_project_are_possible(self) -> None:
        studies = sorted((host.REPOSITORY / "scripts" / "studies").glob("*.toml"))
        self.assertGreater(len(studies), 5)
        for study in studies:
            with self.subTest(study.name):
                said = self.render(study, "out", "--dry-run")
                self.assertRegex(said, r"images are to be rendered: about \d+")


class BlendFileTest(StudyCase):
    def setUp(self) -> None:
        super().setUp()
        script = MAKE_BLEND.replace("FOLDER", str(self.folder))
        host.run(
            host.built_blender(), "-b", "--factory-startup", "--python-exit-code", "1",
            "--python-expr", script, folder=self.folder, seconds=60,
        )  # fmt: skip
        # Where scripts may run, these do: else the test below would show nothing.
        host.run(
            host.built_blender(), "-b", "--factory-startup", "--enable-autoexec",
            self.folder / "scene.blend", folder=self.folder, seconds=60,
        )  # fmt: skip
        for trace in ("evil", "driven"):
            self.assertTrue((self.folder / trace).exists(), trace)
            (self.folder / trace).rename(self.folder / f"was-{trace}")

    def head(self, text: str) -> str:
        return HEAD.replace('picture = "full"', f'blend = "scene.blend"\n{text}')

    def test_settings_reach_the_scene_and_scripts_do_not_run(self) -> None:
        axes = (
            '[[axis]]\nname = "d"\nset = "node.Wire Spacing"\nvalues = [700, 1200]\n'
            '[[axis]]\nname = "x"\nset = \'data.objects["Lamp"].location\'\n'
            "values = [[0, -2, 3], [2, 0, 3]]\n"
        )
        study = self.study(self.head("") + axes)
        self.render(study, "out", *SMALL)
        pictures = [read(p).tobytes() for p in (self.folder / "out").rglob("image.exr")]
        self.assertEqual(len(set(pictures)), 4)
        for trace in ("evil", "driven", "compositor"):
            self.assertFalse((self.folder / trace).exists(), trace)
        self.assertIn("0 rendered", self.render(study, "out", *SMALL))
        with (self.folder / "scene.blend").open("ab") as file:
            file.write(b"\0")
        self.assertIn("4 rendered", self.render(study, "out", *SMALL))

    def test_paths_that_lead_nowhere(self) -> None:
        for line, words in (
            (
                "data.'objects[\"Lmp\"].location' = [0, 0, 1]",
                "leads nowhere: did you mean 'Lamp'?",
            ),
            ("data.'objcts[\"Lamp\"].location' = [0, 0, 1]", "did you mean 'objects'?"),
            ("data.'objects[\"Lamp\"].locatio' = [0, 0, 1]", "did you mean 'location'?"),
            ("data.'objects[\"Lamp\"].location' = [0, 1]", "is not possible here: "),
            ("camera.lens_mm = 3", "does not exist in a scene from a .blend file"),
        ):
            with self.subTest(line):
                said = self.render(self.study(self.head(f"{line}\n")), "out", status=1)
                self.assertIn("study.toml:5: ", said)
                self.assertIn(words, said)
                self.assertEqual(said.count("\n"), 1, said)

    def test_a_file_that_is_no_scene(self) -> None:
        (self.folder / "scene.blend").write_text("no scene")
        said = self.render(self.study(self.head("")), "out", status=1)
        self.assertIn("study.toml:4: blend cannot be opened: ", said)


class InterruptionTest(StudyCase):
    def test_killed_at_random_it_ends_as_if_it_was_not(self) -> None:
        study = self.study(HEAD + SPACINGS + SEEDS)
        self.render(study, "undisturbed", *SMALL)
        rng = random.Random(348)
        for _ in range(4):
            process = self.start(study, "disturbed", *SMALL, "--jobs", "2")
            time.sleep(rng.uniform(1.0, 3.0))
            process.kill()
            process.communicate()
        self.render(study, "disturbed", *SMALL)
        folders = [self.folder / name for name in ("undisturbed", "disturbed")]
        first, second = ({p.relative_to(f) for p in f.rglob("*")} for f in folders)
        self.assertEqual(first, second)
        for path in sorted(folders[0].rglob("image.*")):
            twin = folders[1] / path.relative_to(folders[0])
            np.testing.assert_array_equal(read(path), read(twin))
            if path.suffix == ".png":
                self.assertEqual(path.read_bytes(), twin.read_bytes())

    def test_a_limit_on_files(self) -> None:
        study = self.study(HEAD + SPACINGS)
        size = ("--set", "render.size=[256, 144]", "--set", "render.samples=1")
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, limits[1]))
        try:
            said = self.render(study, "out", *size, status=1)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        self.assertRegex(said, "disk full|File too large")
        self.assertIn("run the same command again", said)
        self.assertEqual(images(self.folder / "out"), {})
        self.assertIn("2 rendered", self.render(study, "out", *size))


class DependenciesTest(StudyCase):
    def test_the_worker_imports_what_its_hash_covers(self) -> None:
        script = (
            f"import sys; sys.path.insert(0, '{PACKAGE.parent}')\n"
            "import icwafer.study.worker\n"
            "for name, module in sys.modules.items():\n"
            "    if name.startswith('icwafer.'): print('USED', module.__file__)\n"
        )
        ended = host.run(
            host.built_blender(), "-b", "--factory-startup", "--python-exit-code", "1",
            "--python-expr", script, folder=self.folder, seconds=60,
        )  # fmt: skip
        used = {Path(line[5:]) for line in ended.output.splitlines() if line.startswith("USED ")}
        self.assertIn(PACKAGE / "scene" / "picture.py", used)
        self.assertEqual(used - set(imported(PACKAGE / "study" / "worker.py")), set())


if __name__ == "__main__":
    unittest.main()
