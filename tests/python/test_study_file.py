# SPDX-License-Identifier: GPL-2.0-or-later
"""Study files: what they may say, and that everything else is refused with line and name."""

from __future__ import annotations

import dataclasses
import json
import unittest

import numpy as np
from study_support import HEAD, StudyCase, axis
from support import write

from icwafer import dependencies
from icwafer.chips.document import write_layout
from icwafer.chips.model import BlockTable, DieSpec, Group, Kind, Layout
from icwafer.chips.presets import PRESETS
from icwafer.chips.spread import Normal
from icwafer.errors import IcwaferError, SettingError
from icwafer.pictures import PICTURES
from icwafer.study import document, fields, plan
from icwafer.study.command import STUDIES
from icwafer.study.plan import Plan


class ReadingCase(StudyCase):
    def plan(self, *parts: str, head: str = HEAD) -> Plan:
        return plan.make(document.read(self.study(*parts, head=head)), "program")

    def values(self, made: Plan, setting: str) -> list:
        return [job.scene[setting] for job in made.jobs]


class SweepsTest(ReadingCase):
    def test_values_and_ranges(self) -> None:
        made = self.plan(axis("a", "camera.lens_mm", [50, 80]))
        self.assertEqual(self.values(made, "camera.lens_mm"), [50, 80])
        head = HEAD + '[[axis]]\nname = "a"\nset = "camera.lens_mm"\n'
        made = self.plan("from = 10\nto = 1000\ncount = 3\nscale = 'log'", head=head)
        self.assertEqual(self.values(made, "camera.lens_mm"), [10, 100, 1000])
        made = self.plan("from = 0.1\nto = 0.5\ncount = 5", head=head.replace("camera.lens_mm",
                         "node.Diffraction"))  # fmt: skip
        self.assertEqual(self.values(made, "node.Diffraction"), [0.1, 0.2, 0.3, 0.4, 0.5])

    def test_axes_make_a_matrix_whose_last_axis_changes_fastest(self) -> None:
        made = self.plan(
            axis("a", "camera.lens_mm", [50, 80]), axis("b", "render.seed", [1, 2, 3])
        )
        self.assertEqual(
            [tuple(job.labels.values()) for job in made.jobs],
            [(50, 1), (50, 2), (50, 3), (80, 1), (80, 2), (80, 3)],
        )
        self.assertEqual(made.jobs[4].id, "a-80_b-2")

    def test_settings_that_change_together(self) -> None:
        made = self.plan(
            '[[axis]]\nname = "a"\nset = ["camera.lens_mm", "render.seed"]\n'
            "values = [[50, 7], [80, 8]]\n"
        )
        self.assertEqual(self.values(made, "render.seed"), [7, 8])
        self.assertEqual([job.id for job in made.jobs], ["a-50", "a-80"])

    def test_cases(self) -> None:
        made = self.plan(
            '[[axis]]\nname = "lamps"\n'
            '[[axis.case]]\nname = "as it is"\n'
            '[[axis.case]]\nname = "One area"\n'
            "[[axis.case.scene.lights]]\n"
            'kind = "AREA"\nposition_mm = [0, 0, 20]\npower_w = 100\n'
            '[[axis.case]]\nname = "dim"\nscene.lights."*".power_w = 1\n'
        )
        self.assertEqual([job.id for job in made.jobs][1], "lamps-one-area")
        lamps = [
            [(light.kind, light.power_w) for light in fields.picture_of(job.scene).lights]
            for job in made.jobs
        ]
        self.assertEqual(
            lamps,
            [[("POINT", 60000), ("SPOT", 50000)], [("AREA", 100)], [("POINT", 1), ("SPOT", 1)]],
        )

    def test_pictures_and_layouts_are_settings_too(self) -> None:
        made = self.plan(axis("picture", "picture", list(PICTURES)))
        for job, (name, picture) in zip(made.jobs, PICTURES.items()):
            plain = dataclasses.replace(picture.die, name="die")
            expected = dataclasses.replace(picture, caption="", die=plain)
            self.assertEqual(fields.picture_of(job.scene), expected, name)
        made = self.plan(axis("layout", "layout", ["fpga", "dram"]), "[scene.die]\nseed = 5\n")
        self.assertEqual(
            [fields.picture_of(job.scene).die.floorplan for job in made.jobs],
            [PRESETS[name].dies[0].floorplan for name in ("fpga", "dram")],
        )
        self.assertEqual(self.values(made, "die.seed"), [5, 5])

    def test_groups_of_a_die(self) -> None:
        spreads = [900, {"mean": 900, "deviation": 5}, {"low": 900, "high": 950}]
        head = HEAD + '[[axis]]\nname = "a"\nset = "die.groups.cache.spacing_nm"\n'
        text = "values = [900, {mean = 900, deviation = 5}, {low = 900, high = 950}]"
        made = self.plan(text, head=head)
        self.assertEqual(self.values(made, "die.groups.cache.spacing_nm"), spreads)
        made = self.plan(text, head=head.replace(".cache.", ".*."))
        self.assertEqual(self.values(made, "die.groups.pads.spacing_nm"), spreads)

    def test_a_study_takes_over_its_base(self) -> None:
        write(
            self.folder / "base.toml",
            HEAD + "camera.lens_mm = 40\nrender.samples = 3\n"
            + axis("a", "render.seed", [1, 2]) + axis("b", "node.Diffuse", [0, 1]),
        )  # fmt: skip
        head = 'version = 1\nname = "x"\nbase = "base.toml"\n[scene]\nrender.samples = 5\n'
        made = self.plan(axis("a", "render.seed", [7]), head=head)
        self.assertEqual([job.id for job in made.jobs], ["a-7_b-0", "a-7_b-1"])
        self.assertEqual(self.values(made, "camera.lens_mm"), [40, 40])
        self.assertEqual(self.values(made, "render.samples"), [5, 5])

    def test_reference(self) -> None:
        head = HEAD.replace("[scene]", "reference = { b = 2 }\n[scene]")
        made = self.plan(axis("a", "camera.lens_mm", [50, 80]), axis("b", "render.seed", [1, 2]),
                         head=head)  # fmt: skip
        self.assertEqual(made.reference, "a-50_b-2")

    def test_settings_of_the_command_line(self) -> None:
        study = document.read(self.study(axis("b", "render.seed", [1, 2])))
        words = ["render.size=[64, 36]", "view.transform=Standard", "node.use_grating=false"]
        made = plan.make(document.overridden(study, words), "program")
        scene = made.jobs[0].scene
        self.assertEqual(scene["render.size"], [64, 36])
        self.assertEqual(scene["view.transform"], "Standard")
        self.assertIs(scene["node.use_grating"], False)
        for word, words in (
            ("render.size", "write SETTING=VALUE"),
            ("render.sise=3", "did you mean 'render.size'"),
        ):
            with self.assertRaisesRegex(IcwaferError, words):
                document.overridden(study, [word])


class RefusalsTest(ReadingCase):
    """Each mistake, the line that it is on, and what the message says of it."""

    def refused(self, line: int, words: str, *parts: str, head: str = HEAD) -> None:
        with self.subTest(words):
            with self.assertRaises(IcwaferError) as caught:
                self.plan(*parts, head=head)
            said = str(caught.exception)
            self.assertTrue(said.startswith(f"{self.folder}/study.toml:{line}: "), said)
            self.assertIn(words, said)
            self.assertNotIn("\n", said)

    def test_typing_errors(self) -> None:
        self.refused(5, "camera.lens_m is no setting: did you mean 'camera.lens_mm'?",
                     "camera.lens_m = 3\n")  # fmt: skip
        self.refused(1, "nam is unknown: did you mean 'name'?", head="nam = 3\n")
        self.refused(7, "axis[1].valeus is unknown: did you mean 'values'?",
                     "[[axis]]\nname = 'a'\nvaleus = [1]\n")  # fmt: skip

    def test_unknown_sockets_and_values(self) -> None:
        socket = "is no input or property of the node: did you mean 'Wire Spacing'?"
        self.refused(6, f"node.Wire Spacng {socket}", '[scene.node]\n"Wire Spacng" = 900\n')
        self.refused(6, "node.model is 'PHYSICL': did you mean 'PHYSICAL'?",
                     '[scene.node]\nmodel = "PHYSICL"\n')  # fmt: skip
        self.refused(4, "picture is 'ful': did you mean 'full'?",
                     head=HEAD.replace('"full"', '"ful"'))  # fmt: skip
        self.refused(5, "lights.3.power_w does not exist: did you mean 'lights.2.power_w'?",
                     "lights.3.power_w = 3\n")  # fmt: skip
        self.refused(5, "die.groups.cash.width_nm does not exist: did you mean "
                     "'die.groups.cache.width_nm'?", "die.groups.cash.width_nm = 200\n")  # fmt: skip

    def test_values_out_of_range(self) -> None:
        self.refused(6, "node.Wire Spacing is 1: allowed are 50 to 200000 (Distance from",
                     '[scene.node]\n"Wire Spacing" = 1\n')  # fmt: skip
        self.refused(8, "render.samples is 0: allowed are 1 to 1000000 (paths per pixel)",
                     axis("a", "render.samples", [4, 0]))  # fmt: skip
        self.refused(5, "render.size is [64]: write 2 values in brackets", "render.size = [64]\n")
        self.refused(5, "camera.lens_mm is nan: write a number", "camera.lens_mm = nan\n")
        self.refused(5, "render.samples is 2.5: write a whole number", "render.samples = 2.5\n")
        self.refused(5, "render.seed is 'x': write a number", 'render.seed = "x"\n')
        self.refused(5, "view.gamma is true: write a number", "view.gamma = true\n")
        self.refused(6, "node.use_grating is 1: write true or false",
                     "[scene.node]\nuse_grating = 1\n")  # fmt: skip
        self.refused(5, "die.groups.cache.spacing_nm is {'men': 9}: write a number or {mean, ",
                     "die.groups.cache.spacing_nm = {men = 9}\n")  # fmt: skip
        self.refused(5, "die.groups.cache.spacing_nm is 40: allowed are 50 to",
                     "die.groups.cache.spacing_nm = {mean = 100, deviation = 20}\n")  # fmt: skip

    def test_lights(self) -> None:
        lamp = "[[scene.lights]]\nkind = 'POINT'\nposition_mm = [0, 0, 1]\npower_w = 1\n"
        self.refused(5, "lights number 1: colr is unknown: did you mean 'colour'?",
                     lamp + "colr = 1\n")  # fmt: skip
        self.refused(5, "lights number 2 has no kind: add it", lamp + "[[scene.lights]]\n")
        self.refused(
            5, "lights number 1: power_w is -1: allowed are 0 to", lamp.replace("= 1", "= -1")
        )

    def test_axes(self) -> None:
        twice = axis("a", "render.seed", [1])
        self.refused(10, "axis[2].name is 'a' a second time", twice, twice)
        self.refused(12, "render.seed is set by two axes, 'a' and 'b'",
                     twice, axis("b", "render.seed", [2]))  # fmt: skip
        self.refused(8, "axis[1].values is empty", axis("a", "render.seed", []))
        self.refused(8, "axis[1].values[2] is 1 a second time", axis("a", "render.seed", [1, 1]))
        self.refused(5, "axis[1] has neither set nor case", "[[axis]]\nname = 'a'\n")
        self.refused(8, "axis[1].scale is 'lgo': did you mean 'log'?",
                     "[[axis]]\nname = 'a'\nset = 'render.seed'\nscale = 'lgo'\n"
                     "from = 1\nto = 2\ncount = 2\n")  # fmt: skip
        self.refused(4, "and the axes make 1020100000 jobs: allowed are 1000000",
                     axis("a", "render.seed", list(range(10100))),
                     axis("b", "camera.lens_mm", list(range(1, 102))),
                     axis("c", "die.seed", list(range(1000))))  # fmt: skip

    def test_files(self) -> None:
        self.refused(5, "layout is 'fgpa': there is no file", 'layout = "fgpa"\n')
        self.refused(5, "environment.image is 'sky.hdr': there is no file",
                     'environment.image = "sky.hdr"\n')  # fmt: skip
        self.refused(3, "base is 'nothing.toml': there is no such file",
                     head=HEAD.replace("[scene]", 'base = "nothing.toml"\n[scene]'))  # fmt: skip
        self.refused(4, "blend is 'a.blend': there is no file",
                     head=HEAD.replace('picture = "full"', 'blend = "a.blend"'))  # fmt: skip

    def test_circles(self) -> None:
        write(self.folder / "a.toml", 'version = 1\nbase = "study.toml"\n')
        with self.assertRaisesRegex(
            IcwaferError,
            r"a.toml:2: base goes round in a circle: study.toml -> a.toml -> study.toml",
        ):
            self.plan(head='version = 1\nname = "x"\nbase = "a.toml"\n')

    def test_the_rest(self) -> None:
        self.refused(1, "version is 2: this icwafer reads version 1", head="version = 2\n")
        self.refused(1, "scene says not what to render", head="version = 1\n")
        self.refused(3, "invalid value", head="version = 1\n\nname = = 3\n")
        self.refused(3, "reference.x is no axis: choose from a", axis("a", "render.seed", [1]),
                     head=HEAD.replace("[scene]", "reference.x = 3\n[scene]"))  # fmt: skip
        self.refused(5, "data.x is a data path, which only a scene from a .blend file has",
                     "data.x = 1\n")  # fmt: skip


class BlocksTest(ReadingCase):
    def test_a_layout_that_lists_its_blocks(self) -> None:
        table = BlockTable.from_um(np.array([[0, 0, 900, 900], [900, 0, 1800, 900]]), [0, 1])
        groups = (Group("one", Kind.LOGIC, Normal(900)), Group("two", Kind.LOGIC, Normal(1000)))
        path = self.folder / "chip.layout.toml"
        keys = []
        for width_mm in (1.8, 1.9):
            write_layout(path, Layout((DieSpec(groups, width_mm=width_mm, height_mm=0.9,
                                               blocks=table),)))  # fmt: skip
            for cache in (fields.layout_settings, fields.layout_die, dependencies.file_hash):
                cache.cache_clear()
            made = self.plan(
                'layout = "chip.layout.toml"\n',
                axis("d", "die.groups.two.spacing_nm", [1100, 1200]),
            )
            keys += [job.key for job in made.jobs]
            die = fields.picture_of(made.jobs[1].scene).die
            self.assertEqual((len(die.blocks), die.width_mm), (2, width_mm))
            self.assertEqual(die.groups[1].spacing_nm, Normal(1200))
        self.assertEqual(len(set(keys)), 4)


class StudiesTest(unittest.TestCase):
    """Those that come with the project."""

    def test_all_make_sense_and_sweep_every_input_of_the_node(self) -> None:
        swept = set()
        for path in STUDIES.glob("*.toml"):
            made = plan.make(document.read(path), "program")
            self.assertGreater(len(made.jobs), 3, path)
            self.assertTrue(made.study.description, path)
            steps = [step for a in made.study.axes for step in a.steps]
            swept |= {a.setting for step in steps for a in step.assignments}
        unswept = {f"node.{name}" for name in fields.node_inputs()} - swept
        self.assertEqual(unswept, set())


class SettingsTest(unittest.TestCase):
    def test_every_picture_survives_json(self) -> None:
        for name, picture in PICTURES.items():
            scene = json.loads(json.dumps(fields.picture_settings(name)))
            plain = dataclasses.replace(picture.die, name="die")
            self.assertEqual(
                fields.picture_of(scene), dataclasses.replace(picture, caption="", die=plain), name
            )

    def test_every_setting_of_a_picture_can_be_set_to_what_it_is(self) -> None:
        for name in PICTURES:
            for setting, value in fields.picture_settings(name).items():
                self.assertEqual(fields.check(setting, value), value, setting)

    def test_every_input_of_the_node_has_its_own_range(self) -> None:
        for name, rule in fields.node_inputs().items():
            self.assertEqual(fields.check(f"node.{name}", rule.high), rule.high)
            with self.assertRaises(SettingError):
                fields.check(f"node.{name}", 2 * rule.high + 1)

    def test_the_list_of_settings_has_help_for_each(self) -> None:
        for name, rule in fields.rules().items():
            self.assertTrue(rule.help, name)


if __name__ == "__main__":
    unittest.main()
