# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of jobs: what changes them and what does not; and what ten thousand jobs take."""

from __future__ import annotations

import time
import unittest
from pathlib import Path

from study_support import HEAD, STAND_IN, StudyCase, axis
from support import write

from icwafer import dependencies
from icwafer.study import document, keys, plan, run
from icwafer.study.order import Order
from icwafer.study.plan import Plan
from icwafer.study.store import Store


class KeysTest(StudyCase):
    def keys(self, *parts: str, head: str = HEAD, program: str = "program", **needs: list) -> dict:
        study = document.read(self.study(*parts, head=head))
        return {job.id: job.key for job in plan.make(study, program, needs).jobs}

    def test_what_does_not_matter_changes_no_key(self) -> None:
        lens, seed = axis("a", "camera.lens_mm", [50, 80]), axis("b", "render.seed", [1])
        first = self.keys(lens, seed)
        self.assertEqual(self.keys(lens, seed, head=HEAD.replace("Test", "Name")), first)
        self.assertEqual(set(self.keys(seed, lens).values()), set(first.values()))
        more = self.keys(axis("a", "camera.lens_mm", [50, 60, 80]), seed)
        self.assertEqual({job: more[job] for job in first}, first)
        self.assertEqual(len(set(more.values())), 3)

    def test_the_order_of_sockets_does_not_matter(self) -> None:
        sockets = ['"Diffuse" = 0.1\n', '"Specular" = 0.2\n']
        one, other = (self.keys("[scene.node]\n", *s) for s in (sockets, sockets[::-1]))
        self.assertEqual(one, other)

    def test_every_setting_matters(self) -> None:
        seed = axis("b", "render.seed", [1])
        found = [
            self.keys(seed)["b-1"],
            self.keys("camera.lens_mm = 70\n", seed)["b-1"],
            self.keys("die.seed = 3\n", seed)["b-1"],
            self.keys("[scene.node]\nuse_grating = false\n", seed)["b-1"],
            self.keys("view.exposure = 1\n", seed)["b-1"],
            self.keys(seed, program="another build")["b-1"],
        ]
        self.assertEqual(len(set(found)), len(found))

    def test_files_count_by_their_content_and_what_they_need(self) -> None:
        head = HEAD.replace('picture = "full"', 'blend = "a.blend"')
        blend, texture = write(self.folder / "a.blend", "1"), write(self.folder / "t.png", "1")
        found = [self.keys(head=head)]
        for path, needs in ((blend, []), (texture, [texture]), (texture, [texture])):
            path.write_text(path.read_text() + "2")
            dependencies.file_hash.cache_clear()
            found.append(self.keys(head=head, **{str(blend): [str(n) for n in needs]}))
        self.assertEqual(len({key["image"] for key in found}), 4)
        blend.rename(self.folder / "b.blend")
        renamed = self.keys(head=head.replace("a.b", "b.b"), **{str(self.folder / "b.blend"): [
            str(texture)]})  # fmt: skip
        self.assertEqual(renamed, found[-1])

    def test_names_of_folders(self) -> None:
        ids = self.keys(
            axis("Exposure (stops)", "view.exposure", [-1.5, 1.5]),
            axis("transform", "view.transform", ["Filmic", "Filmic Log", "filmic log", "Ä/../x"]),
        )
        self.assertEqual(len(ids), 8)
        for name in ids:
            self.assertRegex(name, r"^[a-z0-9][a-z0-9._-]*$")
            self.assertLessEqual(len(name), plan.MAX_ID)
        self.assertIn("exposure-stops-m1.5_transform-filmic", ids)
        long = self.keys(axis("a" * 300, "render.seed", [1, 2]))
        self.assertEqual(len(long), 2)
        self.assertLessEqual(max(map(len, long)), plan.MAX_ID)


class DependenciesTest(unittest.TestCase):
    def test_imports_are_followed(self) -> None:
        found = {
            str(path.relative_to(dependencies.PACKAGE))
            for path in dependencies.imported(keys.WORKER)
        }
        for name in ("study/worker.py", "scene/picture.py", "chips/die.py", "errors.py"):
            self.assertIn(name, found)
        self.assertNotIn("cli.py", found)
        self.assertNotIn("study/slurm.py", found)


class TenThousandJobsTest(StudyCase):
    """In memory and in time of this process, for a busy machine says nothing about the program."""

    place = "/dev/shm" if Path("/dev/shm").is_dir() else None

    def planned(self) -> tuple[Order, Plan]:
        path = self.study(
            axis("spacing", "node.Wire Spacing", list(range(800, 900))),
            axis("lobe", "node.Lobe Width", [0.01 + 0.001 * i for i in range(10)]),
            axis("seed", "render.seed", list(range(10))),
        )
        order = Order(path, self.folder / "out", STAND_IN)
        return order, run.prepare(order)

    def test_planning_and_resuming(self) -> None:
        begin = time.process_time()
        order, made = self.planned()
        self.assertEqual(len(run.missing(order, made)), 10_000)
        planning = time.process_time() - begin
        self.assertLess(planning, 5.0)
        store = Store(order.folder)
        store.jobs.mkdir(parents=True)
        for job in made.jobs[:-1]:
            part = store.part(job)
            for name in ("image.exr", "image.png", "log.txt"):
                Path(part / name).write_bytes(b"x")
            store.commit(job, part, {**order.facts(job), "status": "done", "error": None})
        begin = time.process_time()
        order, made = self.planned()
        self.assertEqual(run.missing(order, made), [made.jobs[-1]])
        resuming = time.process_time() - begin
        print(f"10,000 jobs: planned in {planning:.1f} s, resumed in {resuming:.1f} s")
        self.assertLess(resuming, 10.0)

    def test_what_a_job_costs_besides_its_rendering(self) -> None:
        path = self.study(axis("seed", "render.seed", list(range(200))))
        order = Order(path, self.folder / "out", STAND_IN)
        made, store = run.prepare(order), Store(order.folder)
        store.jobs.mkdir(parents=True)
        begin = time.perf_counter()
        outcomes = list(run.render_here(made.jobs, made, store, order))
        per_job = (time.perf_counter() - begin) / len(made.jobs)
        self.assertEqual([outcome.error for outcome in outcomes], [""] * 200)
        print(f"a job costs {1000 * per_job:.1f} ms besides its rendering")
        self.assertLess(per_job, 0.05)


if __name__ == "__main__":
    unittest.main()
