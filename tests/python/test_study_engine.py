# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies survive crashes, kills and full disks, and render only what is missing or changed."""

from __future__ import annotations

import json
import random
import resource
import shutil
import subprocess
import time
import unittest
from pathlib import Path

import stand_in_blender
from study_support import HEAD, STAND_IN, StudyCase, axis, images, names
from support import REPOSITORY, write

from icwafer.study.order import Order

SEEDS = axis("seed", "render.seed", [1, 2, 3])


class ResultsTest(StudyCase):
    def test_matrix_of_jobs(self) -> None:
        study = self.study(SEEDS, axis("lobe", "node.Lobe Width", [0.01, 0.02]))
        output = self.folder / "out"
        said = self.render(study, output, "--jobs", "2")
        self.assertIn("6 rendered, 0 were there, 0 failed", said)
        facts = self.facts(output)
        self.assertEqual(len(facts), 6)
        job = facts["seed-2_lobe-0.01"]
        self.assertEqual(job["settings"], {"seed": 2, "lobe": 0.01})
        self.assertEqual((job["status"], job["seed"], job["samples"]), ("done", 2, 32))
        self.assertEqual(job["scene"]["node.Lobe Width"], 0.01)
        study_facts = json.loads((output / "study.json").read_text())
        self.assertEqual(
            study_facts["axes"],
            [
                {"name": "seed", "unit": "", "values": [1, 2, 3]},
                {"name": "lobe", "unit": "", "values": [0.01, 0.02]},
            ],
        )
        self.assertEqual(set(study_facts["jobs"]), set(facts))

    def test_the_command_of_a_job_renders_just_that(self) -> None:
        output = self.folder / "out"
        self.render(self.study(SEEDS), output)
        before = images(output)
        command = self.facts(output)["seed-2"]["command"]
        shutil.rmtree(output / "jobs" / "seed-1")
        shutil.rmtree(output / "jobs" / "seed-2")
        subprocess.run(
            command, cwd=REPOSITORY, env=self.environment, check=True, capture_output=True
        )
        self.assertEqual(
            images(output), {k: v for k, v in before.items() if not k.startswith("jobs/seed-1")}
        )

    def test_commands_name_what_is_in_the_repository_from_there(self) -> None:
        study = REPOSITORY / "scripts" / "studies" / "metals.toml"
        order = Order(study, self.folder, settings=("render.samples=1",))
        self.assertEqual(
            " ".join(order.command("a")),
            f"scripts/icwafer render scripts/studies/metals.toml -o {self.folder} "
            "--set render.samples=1 --only a",
        )

    def test_only_what_is_missing_or_changed(self) -> None:
        output = self.folder / "out"
        self.render(self.study(SEEDS), output)
        study = self.study(axis("seed", "render.seed", [1, 2, 3, 4]))
        self.assertIn("1 rendered, 3 were there", self.render(study, output))
        study = self.study("camera.lens_mm = 70\n", SEEDS)
        self.assertIn("3 rendered, 0 were there", self.render(study, output))
        new_text = HEAD.replace("Test", "Another name")
        study = self.study("camera.lens_mm = 70\n", SEEDS, head=new_text)
        self.assertIn("0 rendered, 3 were there", self.render(study, output))
        (output / "jobs" / "seed-1" / "image.png").write_bytes(b"cut off")
        (output / "jobs" / "seed-2" / "job.json").write_text("{")
        self.assertIn("2 rendered, 1 were there", self.render(study, output))

    def test_results_that_are_no_longer_asked_for_are_put_aside(self) -> None:
        output = self.folder / "out"
        self.render(self.study(SEEDS), output)
        self.render(self.study(axis("seed", "render.seed", [2, 9])), output)
        self.assertEqual(set(self.facts(output)), {"seed-2", "seed-9"})
        self.assertIn("0 rendered, 3 were there", self.render(self.study(SEEDS), output))

    def test_a_folder_belongs_to_one_study(self) -> None:
        output = self.folder / "out"
        study = self.study(SEEDS)
        self.render(study, output)
        other = study.rename(self.folder / "other.toml")
        said = self.render(other, output, status=1)
        self.assertIn(
            "holds the results of study.toml; choose another folder for other.toml", said
        )

    def test_orders_can_be_drawn_where_all_wires_are_alike(self) -> None:
        output = self.folder / "out"
        spacings = axis("d", "node.Wire Spacing", [900, 1100])
        self.render(self.study("[scene.node]\nDirection = 0.5\n", spacings), output)
        first, second = self.facts(output)["d-900"]["grating"]  # one for each of the two lamps
        self.assertEqual((first["spacing_nm"], first["direction_rad"]), (900, 0.5))
        self.assertEqual(first["light"]["position_mm"], [6, -14, 26])
        self.assertEqual(second["light"]["position_mm"], [-16, -20, 16])
        self.render(self.study(SEEDS), self.folder / "various")
        self.assertEqual(self.facts(self.folder / "various")["seed-1"]["grating"], [])

    def test_another_build_renders_anew(self) -> None:
        output, blender = self.folder / "out", self.folder / "blender"
        shutil.copy(STAND_IN, blender)
        self.environment["ICWAFER_BLENDER"] = str(blender)
        study = self.study(SEEDS)
        self.render(study, output)
        with blender.open("a") as file:
            file.write("# another build\n")
        self.assertIn("3 rendered, 0 were there", self.render(study, output))

    def test_a_changed_file_renders_anew(self) -> None:
        output, panorama = self.folder / "out", write(self.folder / "sky.hdr", "one")
        study = self.study('environment = { image = "sky.hdr", strength = 1 }\n', SEEDS)
        self.render(study, output)
        panorama.write_text("two")
        self.assertIn("3 rendered, 0 were there", self.render(study, output))

    def test_jobs_that_differ_in_their_view_share_the_light(self) -> None:
        output = self.folder / "out"
        gammas = axis("gamma", "view.gamma", [1, 2])
        self.render(self.study(SEEDS, gammas), output, "--jobs", "2")
        facts = self.facts(output)
        rendered = [job["settings"]["seed"] for job in facts.values() if job["rendered"]]
        self.assertEqual(sorted(rendered), [1, 2, 3])
        # What is there serves the next run, too: another view, and one more.
        study = self.study("view.transform = 'Raw'\n", SEEDS, axis("gamma", "view.gamma", [1, 3]))
        self.assertIn("about", self.render(study, output, "--dry-run"))
        self.assertIn("6 rendered", self.render(study, output))
        self.assertFalse(any(job["rendered"] for job in self.facts(output).values()))

    def test_dry_run_renders_nothing(self) -> None:
        output = self.folder / "out"
        said = self.render(self.study(SEEDS), output, "--dry-run")
        self.assertIn("seed-1\nseed-2\nseed-3\n3 of 3 images are to be rendered: about", said)
        self.assertFalse(output.exists())

    def test_what_blender_refuses_is_refused_before_rendering(self) -> None:
        study = self.study(axis("model", "node.model", ["CS348B", "PHYSICAL"]))
        output = self.folder / "out"
        said = self.render(study, output, status=1)
        self.assertIn(f"{study}:8: node.model is not possible here", said)
        self.assertEqual(images(output), {})


class CrashTest(StudyCase):
    def run_with(self, *exposures: float, arguments: tuple[str, ...] = (), status: int) -> dict:
        output = self.folder / "out"
        study = self.study(axis("e", "view.exposure", list(exposures)))
        self.said = self.render(study, output, *arguments, status=status)
        self.assertFalse([name for name in names(output) if "/." in name], "left-overs")
        return {job: facts["error"] for job, facts in self.facts(output).items()}

    def test_a_crash_costs_one_job(self) -> None:
        errors = self.run_with(0, stand_in_blender.CRASH, 0.5, status=1)
        self.assertEqual(
            errors, {"e-0": None, "e-1": "the renderer crashed (SIGSEGV)", "e-0.5": None}
        )
        self.assertIn("failed: e-1: the renderer crashed (SIGSEGV)", self.said)
        self.assertTrue((self.folder / "out" / "jobs" / "e-1" / "log.txt").read_text())

    def test_a_crash_that_other_jobs_cause_is_tried_again(self) -> None:
        errors = self.run_with(0, stand_in_blender.CRASH_LATER, 0.5, status=0)
        self.assertEqual(set(errors.values()), {None})

    def test_an_error_is_the_jobs_alone(self) -> None:
        errors = self.run_with(0, stand_in_blender.FAIL, status=1)
        self.assertEqual(errors, {"e-0": None, "e-2": "there is no camera"})

    def test_a_job_that_hangs_is_ended(self) -> None:
        errors = self.run_with(stand_in_blender.HANG, 0, arguments=("--timeout", "1"), status=1)
        self.assertEqual(errors, {"e-3": "the renderer took longer than 1 s", "e-0": None})

    def test_a_failed_job_is_tried_again_next_time(self) -> None:
        self.run_with(0, stand_in_blender.CRASH, status=1)
        self.run_with(0, stand_in_blender.CRASH, status=1)
        self.assertIn("0 rendered, 1 were there, 1 failed", self.said)

    def test_workers_are_reused_or_not(self) -> None:
        study = self.study(SEEDS)
        for arguments, workers in (((), 1), (("--isolate",), 3)):
            output = self.folder / f"out{workers}"
            self.render(study, output, *arguments)
            logs = {path.read_text().split()[-1] for path in output.rglob("log.txt")}
            self.assertEqual(len(logs), workers)
        self.assertEqual(images(self.folder / "out1"), images(self.folder / "out3"))

    def test_workers_share_the_cores(self) -> None:
        output = self.folder / "out"
        self.render(self.study(SEEDS), output, "--jobs", "64")
        self.assertEqual({facts["threads"] for facts in self.facts(output).values()}, {1})

    def test_a_renderer_that_does_not_start(self) -> None:
        broken = write(
            self.folder / "blender", "#!/bin/sh\necho Error: no libfoo; exit 3\n", 0o755
        )
        for path, words in (
            (broken, "blender does not start: Error: no libfoo; scripts/icwafer doctor"),
            (self.folder / "nothing", "there is no Blender at"),
        ):
            self.environment["ICWAFER_BLENDER"] = str(path)
            said = self.render(self.study(SEEDS), self.folder / "out", status=1)
            self.assertIn(words, said)
            self.assertEqual(said.count("\n"), 1, said)


class InterruptionTest(StudyCase):
    def test_killed_twenty_times_it_ends_as_if_it_was_not(self) -> None:
        study = self.study(
            axis("seed", "render.seed", list(range(25))),
            axis("lobe", "node.Lobe Width", [0.01, 0.02, 0.03, 0.04]),
        )
        undisturbed, disturbed = self.folder / "undisturbed", self.folder / "disturbed"
        self.render(study, undisturbed)
        self.environment["ICWAFER_STAND_IN_S"] = "0.05"
        rng = random.Random(348)
        present = [0]
        for _ in range(20):
            # Mostly while it renders: from when it has written the study's description anew.
            begun = self.written(disturbed)
            process = self.start(study, disturbed, "--jobs", "2")
            while self.written(disturbed) == begun and process.poll() is None:
                if rng.random() < 0.002:
                    break
                time.sleep(0.005)
            time.sleep(rng.uniform(0.0, 0.4))
            process.kill()
            process.communicate()
            present.append(len(self.facts(disturbed)))
        self.assertEqual(present, sorted(present), "a finished job was lost")
        self.assertGreater(len(set(present)), 4, "hardly any kill came while it rendered")
        self.render(study, disturbed)
        self.assertEqual(images(disturbed), images(undisturbed))
        self.assertEqual(names(disturbed), names(undisturbed))

    @staticmethod
    def written(output: Path) -> int:
        """When the study's description was written, 0 if it was not."""
        path = output / "study.json"
        return path.stat().st_mtime_ns if path.exists() else 0

    def test_nothing_lives_on_after_a_kill(self) -> None:
        self.environment["ICWAFER_STAND_IN_S"] = "0.5"
        blender = shutil.copy(STAND_IN, self.folder / "blender")  # to be known by its name
        self.environment["ICWAFER_BLENDER"] = str(blender)
        output = self.folder / "out"
        process = self.start(self.study(SEEDS), output)
        while process.poll() is None and not list(output.glob("jobs/.part-*/image.exr")):
            time.sleep(0.02)
        self.assertTrue(self.running(blender))
        process.kill()
        process.communicate()
        end = time.monotonic() + 30
        while self.running(blender) and time.monotonic() < end:
            time.sleep(0.1)
        self.assertFalse(self.running(blender))

    @staticmethod
    def running(program: Path) -> bool:
        return subprocess.run(["pgrep", "-f", str(program)], capture_output=True).returncode == 0

    def test_two_at_once(self) -> None:
        self.environment["ICWAFER_STAND_IN_S"] = "600"
        study, output = self.study(SEEDS), self.folder / "out"
        with self.start(study, output) as first:
            while not (output / "study.json").exists():
                time.sleep(0.02)
            said = self.render(study, output, status=1)
            self.assertIn("another icwafer renders to this folder", said)
            first.terminate()
            first.communicate()

    def test_ctrl_c(self) -> None:
        self.environment["ICWAFER_STAND_IN_S"] = "0.3"
        study, output = self.study(SEEDS), self.folder / "out"
        with self.start(study, output) as process:
            while not (output / "study.json").exists():
                time.sleep(0.02)
            process.terminate()
            _, err = process.communicate()
        self.assertEqual((process.returncode, err.count("\n")), (130, 1))
        self.assertFalse([name for name in names(output) if "/." in name])


class NoRoomTest(StudyCase):
    def test_a_limit_on_files(self) -> None:
        study, output = self.study(SEEDS), self.folder / "out"
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, limits[1]))
        try:
            said = self.render(study, output, status=1)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        self.assertIn("File too large", said)
        self.assertIn("run the same command again to go on", said)
        self.assertEqual(said.splitlines()[-1].count("icwafer: "), 1)
        self.assertEqual(images(output), {})
        self.assertIn("3 rendered", self.render(study, output))

    def test_a_full_disk(self) -> None:
        """On a file system of 200 kB, which one image of three does not fit on, until made room."""
        study = self.study(SEEDS)
        disk = self.folder / "disk"
        disk.mkdir()
        command = f"{REPOSITORY}/scripts/icwafer render {study} -o {disk}/out"
        script = f"""
            mount -t tmpfs -o size=200k none {disk}
            head -c 80000 /dev/zero > {disk}/ballast
            {command} && exit 10
            ls -A {disk}/out/jobs
            rm {disk}/ballast
            {command}
        """
        done = subprocess.run(
            ["unshare", "--mount", "--map-root-user", "sh", "-c", script],
            env=self.environment,
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertNotIn(".part", done.stdout)
        self.assertIn("0 failed", done.stdout)

    def test_folders_that_cannot_be_written(self) -> None:
        study = self.study(SEEDS)
        taken = write(self.folder / "taken", "")
        for output in (taken, taken / "below", "/proc/icwafer"):
            with self.subTest(output):
                said = self.render(study, output, status=1)
                self.assertTrue(said.startswith("icwafer: "), said)
                self.assertIn(str(output), said)
                self.assertEqual(said.count("\n"), 1, said)


if __name__ == "__main__":
    unittest.main()
