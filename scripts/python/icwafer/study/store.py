# SPDX-License-Identifier: GPL-2.0-or-later
"""The folder that a study is rendered to.

    study.json               name, description, axes, the jobs' ids, reference, versions, command
    jobs/ID/image.exr        linear light, half floats; its metadata says how to repeat it
    jobs/ID/image.png        as a screen shows it
    jobs/ID/log.txt          what Blender wrote
    jobs/ID/job.json         settings, key, time, status, error, command

Results of an earlier version of the study that it no longer asks for are put aside in `unused/`.

A job's folder appears by renaming, so it is there complete or not at all; `job.json` has the sizes
of the files beside it, so that a file cut off by a power failure is noticed, too. What is still
being made has a name that begins with a point.
"""

from __future__ import annotations

import fcntl
import json
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.study.plan import Job

LIGHT = "image.exr"
IMAGES = (LIGHT, "image.png")
LOG = "log.txt"
_PART = ".part-"
_OLD = ".old-"


@dataclass(frozen=True)
class Store:
    """A folder of results."""

    folder: Path

    @property
    def jobs(self) -> Path:
        return self.folder / "jobs"

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Keeps other processes from rendering to the folder; the lock ends with this process.

        Raises IcwaferError where another one has it, OSError where the folder cannot be written.
        """
        self.jobs.mkdir(parents=True, exist_ok=True)
        with open(self.folder / ".lock", "w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise IcwaferError(
                    f"{self.folder}: another icwafer renders to this folder; wait for it, or "
                    "choose another one"
                ) from None
            yield

    def arrange(self, jobs: Sequence[Job]) -> None:
        """Puts results that no job asks for aside, and takes back what is asked for again."""
        aside = self.folder / "unused"
        wanted = {job.id for job in jobs}
        for path in list(self.jobs.iterdir()):
            if path.name not in wanted and not path.name.startswith("."):
                aside.mkdir(exist_ok=True)
                shutil.rmtree(aside / path.name, ignore_errors=True)
                path.rename(aside / path.name)
        for path in list(aside.iterdir()) if aside.is_dir() else ():
            if path.name in wanted and not (self.jobs / path.name).exists():
                path.rename(self.jobs / path.name)

    def clean(self) -> None:
        """Removes what an earlier run left unfinished."""
        for path in self.jobs.iterdir():
            if path.name.startswith((_PART, _OLD)):
                shutil.rmtree(path)

    def part(self, job: Job) -> Path:
        """A new empty folder for the files of a job in the making."""
        path = self.jobs / f"{_PART}{job.id}-{os.uname().nodename}-{os.getpid()}"
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def is_finished(self, job: Job) -> bool:
        """Whether the result is there, complete, and of just these settings."""
        facts = self.facts(job)
        return (
            facts.get("key") == job.key
            and facts.get("status") == "done"
            and all(
                _size(self.jobs / job.id / name) == facts.get("files", {}).get(name)
                for name in IMAGES
            )
        )

    def lights(self, jobs: Iterable[Job]) -> dict[str, Path]:
        """The linear images that some jobs have left, by the keys of their light."""
        found = {}
        for job in jobs:
            facts, image = self.facts(job), self.jobs / job.id / LIGHT
            if facts.get("status") == "done" and _size(image) == facts["files"].get(LIGHT):
                found[facts.get("light_key", "")] = image
        return found

    def facts(self, job: Job) -> Mapping[str, Any]:
        """What `job.json` says; nothing where it is missing or unreadable."""
        try:
            facts = json.loads((self.jobs / job.id / "job.json").read_bytes())
        except (OSError, ValueError):
            return {}
        return facts if isinstance(facts, dict) else {}

    def commit(self, job: Job, part: Path, facts: Mapping[str, Any]) -> None:
        """Puts a finished or failed job in its place, with `facts` in its `job.json`.

        A worse result never replaces a better one: a failure leaves a finished image of the same
        settings alone.
        """
        if facts["status"] != "done" and self.is_finished(job):
            shutil.rmtree(part)
            return
        files = {path.name: path.stat().st_size for path in sorted(part.iterdir())}
        text = json.dumps({**facts, "files": files}, indent=1)
        (part / "job.json").write_text(f"{text}\n", encoding="utf-8")
        final = self.jobs / job.id
        old = self.jobs / f"{_OLD}{part.name.removeprefix(_PART)}"
        if final.exists():
            final.rename(old)
        part.rename(final)
        shutil.rmtree(old, ignore_errors=True)

    def expect_study(self, source: str) -> None:
        """Raises IcwaferError where the folder holds the results of another study file."""
        path = self.folder / "study.json"
        try:
            held = json.loads(path.read_bytes())["source"]
        except (OSError, ValueError, KeyError, TypeError):
            return
        if held != source:
            raise IcwaferError(
                f"{self.folder}: holds the results of {held}; choose another folder for {source}, "
                f"or remove {path} to have them replaced"
            )

    def write_study(self, facts: Mapping[str, Any]) -> None:
        """Writes `study.json`: complete or not at all."""
        with replacing(self.folder / "study.json") as unfinished:
            unfinished.write_text(f"{json.dumps(facts, indent=1)}\n", encoding="utf-8")


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return -1
