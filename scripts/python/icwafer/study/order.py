# SPDX-License-Identifier: GPL-2.0-or-later
"""What is to be rendered, where and with what; and what is noted about it in the results."""

from __future__ import annotations

import json
import os
import platform
import shlex
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from icwafer import paths
from icwafer.dependencies import file_hash, scripts_hash
from icwafer.errors import IcwaferError
from icwafer.progress import first_error
from icwafer.study import fields, keys
from icwafer.study.grating import gratings
from icwafer.study.plan import Job
from icwafer.study.workers import Renderer


@dataclass(frozen=True)
class Order:
    """An order to render a study; all paths are absolute.

    settings: `SETTING=VALUE` words that replace what the study sets for all images. only: ids of
    jobs, all if there is none. workers, isolate, timeout_s: see `Renderer`. threads: of each
    worker; if that is not said, the workers share the machine's cores evenly.
    """

    study: Path
    folder: Path
    blender: Path = paths.BLENDER
    settings: tuple[str, ...] = ()
    only: tuple[str, ...] = ()
    workers: int = 1
    isolate: bool = False
    timeout_s: float = 3600.0
    threads: int | None = None

    @cached_property
    def renderer(self) -> Renderer:
        """Blender as a worker."""
        threads = self.threads or max(1, len(os.sched_getaffinity(0)) // self.workers)
        command = [self.blender, "-b", "--factory-startup", "--disable-autoexec"]
        command += ["--threads", threads, "--python-exit-code", 1, "-P", keys.WORKER, "--"]
        return Renderer(tuple(map(str, command)), self.workers, self.isolate, self.timeout_s)

    @cached_property
    def program(self) -> Mapping[str, str]:
        """Hashes of all that renders: Blender with the node, its colours, our scripts."""
        if not self.blender.is_file():
            raise IcwaferError(
                f"there is no Blender at {self.blender}; run scripts/icwafer build blender"
            )
        return {
            "node_build": file_hash(self.blender),
            "colour_config": _hash_if_there(_colour_config(self.blender)),
            "scripts": scripts_hash(keys.WORKER),
        }

    @cached_property
    def key(self) -> str:
        """Stands for the program in the jobs' keys."""
        return " ".join(self.program.values())

    @cached_property
    def versions(self) -> Mapping[str, str]:
        """What takes part. Raises IcwaferError where Blender does not start."""
        try:
            done = subprocess.run(
                [self.blender, "--version"], capture_output=True, text=True, timeout=60
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise IcwaferError(f"{self.blender} does not start: {error}") from None
        if done.returncode != 0:
            reason = first_error(done.stdout + done.stderr)
            raise IcwaferError(
                f"{self.blender} does not start: {reason}; scripts/icwafer doctor checks it"
            )
        return {
            "blender": done.stdout.splitlines()[0].removeprefix("Blender "),
            **self.program,
            "python": platform.python_version(),
            "study_format": keys.FORMAT,
        }

    def command(self, *jobs: str) -> list[str]:
        """The words that render the study again, or some jobs of it, in the repository's folder."""
        words = ["scripts/icwafer", "render", _there(self.study), "-o", _there(self.folder)]
        for setting in self.settings:
            words += ["--set", setting]
        for job in jobs:
            words += ["--only", job]
        return [str(word) for word in words]

    def attributes(self, job: Job, study: str) -> dict[str, str]:
        """The metadata of a job's EXR file: all that is needed to render it again."""
        return {
            "study": study,
            "job": job.id,
            "settings": json.dumps(dict(job.labels)),
            "scene": json.dumps(job.scene),
            "seed": str(job.scene.get("render.seed", "that of the file")),
            "key": job.key,
            "light_key": job.light_key,
            "versions": json.dumps(dict(self.versions)),
            "node_build": self.program["node_build"],
            "command": shlex.join(self.command(job.id)),
        }

    def facts(self, job: Job) -> dict[str, Any]:
        """What a job's `job.json` says, besides how it went."""
        from_file = fields.BLEND in job.scene
        return {
            "id": job.id,
            "settings": dict(job.labels),
            "key": job.key,
            "light_key": job.light_key,
            "command": self.command(job.id),
            "scene": job.scene,
            "grating": [] if from_file else gratings(fields.picture_of(job.scene)),
        }


def _there(path: Path) -> Path:
    """A path as seen from the repository, where it is inside."""
    inside = path.is_relative_to(paths.REPOSITORY)
    return path.relative_to(paths.REPOSITORY) if inside else path


def _colour_config(blender: Path) -> Path:
    """The OpenColorIO configuration that this Blender uses."""
    own = sorted(blender.parent.glob("*/datafiles/colormanagement/config.ocio"))
    return Path(os.environ.get("OCIO") or (own[-1] if own else ""))


def _hash_if_there(path: Path) -> str:
    return file_hash(path) if path.is_file() else "none"
