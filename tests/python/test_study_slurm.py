# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies on a real Slurm cluster: munged, slurmctld and two slurmd, which this test starts."""

from __future__ import annotations

import getpass
import subprocess
import time
import unittest

import slurm_cluster
from slurm_cluster import wait_until
from study_support import StudyCase, axis, images, names

SEEDS = axis("seed", "render.seed", list(range(8)))
SLURM = ("--engine", "slurm")


class SlurmTest(StudyCase):
    def setUp(self) -> None:
        super().setUp()
        self.cluster = self.enterContext(slurm_cluster.cluster())
        self.environment |= self.cluster.environment

    def test_a_study_finishes_although_a_node_and_the_command_die(self) -> None:
        study, output = self.study(SEEDS), self.folder / "out"
        undisturbed = self.folder / "undisturbed"
        self.render(study, undisturbed)
        self.environment["ICWAFER_STAND_IN_S"] = "1"
        process = self.start(study, output, *SLURM)
        wait_until(lambda: self.cluster.running_on("node1"), 30, "a task on node1")
        time.sleep(0.5)
        self.cluster.kill_node("node1")
        process.kill()  # the command, too: started again it waits for the same array
        process.communicate()
        said = self.render(study, output, *SLURM)
        self.assertIn("0 failed", said)
        self.assertEqual(images(output), images(undisturbed))
        self.assertEqual(names(output), names(undisturbed))
        arrays = {facts["array"] for facts in self.facts(output).values()}
        self.assertEqual(len(arrays), 1, "submitted again, though the array went on")

    def test_errors_and_cancelling(self) -> None:
        study, output = self.study(axis("e", "view.exposure", [0, 2])), self.folder / "out"
        said = self.render(study, output, *SLURM, status=1)
        self.assertIn("failed: e-2: there is no camera", said)
        self.assertIn("1 rendered, 0 were there, 1 failed", said)

        self.environment["ICWAFER_STAND_IN_S"] = "60"
        output = self.folder / "cancelled"
        with self.start(self.study(SEEDS), output, *SLURM) as process:
            wait_until(lambda: self.cluster.running_on("node1"), 30, "a task on node1")
            subprocess.run(
                ["scancel", f"--user={getpass.getuser()}"], env=self.environment, check=True
            )
            _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 1)
        self.assertIn("was cancelled; run the same command again", err)

        said = self.render(study, output, *SLURM, "--sbatch=--partition=nowhere", status=1)
        self.assertIn("icwafer: sbatch: Batch job submission failed: Invalid partition", said)
        self.assertEqual(said.count("\n"), 1, said)


if __name__ == "__main__":
    unittest.main()
