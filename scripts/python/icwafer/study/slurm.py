# SPDX-License-Identifier: GPL-2.0-or-later
"""Has a Slurm cluster render the jobs of a study, as one job array, and collects the results.

Every task of the array renders its share of the jobs (`icwafer.study.slurm_task`) straight into
the folder of the results, which all nodes must see under the same path, as well as Blender and
this repository. A task whose node dies is queued again by Slurm, and then renders only what is missing.
Where this process is killed the array goes on; started again, it waits for the same array.
"""

from __future__ import annotations

import dataclasses
import json
import re
import shlex
import shutil
import subprocess
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from icwafer import paths
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.study.local import Outcome
from icwafer.study.order import Order
from icwafer.study.plan import Job, Plan
from icwafer.study.run import Engine
from icwafer.study.store import Store

#: How often the folder and the queue are looked at.
POLL_S = 1.0
#: How often what an array has left undone is submitted again.
ROUNDS = 3
PYTHON = "/usr/bin/python3"


def engine(options: tuple[str, ...] = ()) -> Engine:
    """The engine; `options` are for sbatch, after our own.

    Raises IcwaferError where there is no Slurm.
    """
    if not shutil.which("sbatch"):
        raise IcwaferError("there is no sbatch here: install slurm-client, or use --engine local")

    def render(jobs: Sequence[Job], made: Plan, store: Store, order: Order) -> Iterator[Outcome]:
        return _Collector(store, order, made.study.name, options).render(jobs)

    return render


@dataclass(frozen=True)
class Share:
    """What one task of an array renders; it goes to the node as a file."""

    order: Order
    study: str
    array: str
    jobs: tuple[Job, ...]

    def write(self, path: Path) -> None:
        with replacing(path) as unfinished:
            text = json.dumps(dataclasses.asdict(self), default=str)
            unfinished.write_text(text, encoding="utf-8")

    @classmethod
    def read(cls, path: Path) -> Share:
        data = json.loads(path.read_text(encoding="utf-8"))
        order = data["order"]
        for name in ("study", "folder", "blender"):
            order[name] = Path(order[name])
        for name in ("settings", "only"):
            order[name] = tuple(order[name])
        jobs = tuple(Job(**job) for job in data["jobs"])
        return cls(Order(**order), data["study"], data["array"], jobs)


@dataclass
class _Collector:
    """Submits arrays and waits for their results."""

    store: Store
    order: Order
    study: str
    options: tuple[str, ...]

    @property
    def folder(self) -> Path:
        """The shares and logs of the tasks."""
        return self.store.folder.resolve() / "slurm"

    def render(self, jobs: Sequence[Job]) -> Iterator[Outcome]:
        waiting = {job.id: job for job in jobs}
        for _ in range(ROUNDS):
            if not waiting:
                break
            array = self._running(waiting) or self._submit(list(waiting.values()))
            try:
                yield from self._collect(array, waiting)
            except BaseException:
                _slurm("scancel", array)
                raise
            if waiting and "JobState=CANCELLED" in _slurm("scontrol", "-o", "show", "job", array):
                raise IcwaferError(
                    f"the array {array} was cancelled; run the same command again to go on"
                )
        for job in waiting.values():
            yield Outcome(job, f"Slurm ended its task {ROUNDS} times; logs are in {self.folder}")
        shutil.rmtree(self.folder, ignore_errors=not waiting)

    def _collect(self, array: str, waiting: dict[str, Job]) -> Iterator[Outcome]:
        """Yields results as they appear, until none is waited for or the array has ended."""
        active = True
        while active and waiting:
            active = _is_active(array)  # asked first: what it has done until then is there
            for job in list(waiting.values()):
                facts = self.store.facts(job)
                if self.store.is_finished(job):
                    del waiting[job.id]
                    yield Outcome(job, "")
                elif facts.get("array") == array and facts.get("status") == "failed":
                    del waiting[job.id]
                    yield Outcome(job, facts["error"])
            if active and waiting:
                time.sleep(POLL_S)

    def _running(self, waiting: dict[str, Job]) -> str | None:
        """The array of an earlier start that still runs and renders all that is waited for."""
        try:
            noted = json.loads((self.folder / "array.json").read_bytes())
        except (OSError, ValueError):
            return None
        if not _is_active(noted["array"]):
            return None
        if {job.key for job in waiting.values()} <= set(noted["keys"]):
            return noted["array"]
        _slurm("scancel", noted["array"])
        return None

    def _submit(self, jobs: list[Job]) -> str:
        self.store.clean()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        # Jobs that share their light go to one task, which renders it once.
        alike: dict[str, list[Job]] = {}
        for job in jobs:
            alike.setdefault(job.light_key, []).append(job)
        tasks = min(len(alike), _largest_array())
        # Held until the shares are there, which have the array's number in them.
        array = _slurm(
            "sbatch",
            "--parsable",
            "--hold",
            "--requeue",
            "--job-name=icwafer",
            f"--array=0-{tasks - 1}",
            f"--output={self.folder}/log-%a.txt",
            "--open-mode=append",
            *self.options,
            given=self._script(),
        ).split(";")[0]
        try:
            for task in range(tasks):
                groups = list(alike.values())[task::tasks]
                share = tuple(job for group in groups for job in group)
                order = dataclasses.replace(self.order, workers=1)
                Share(order, self.study, array, share).write(self.folder / f"share-{task}.json")
            with replacing(self.folder / "array.json") as unfinished:
                note = {"array": array, "keys": [job.key for job in jobs]}
                unfinished.write_text(json.dumps(note), encoding="utf-8")
            _slurm("scontrol", "release", array)
        except BaseException:
            _slurm("scancel", array)
            raise
        return array

    def _script(self) -> str:
        package = shlex.quote(str(paths.REPOSITORY / "scripts" / "python"))
        share = f'{shlex.quote(str(self.folder))}/share-"$SLURM_ARRAY_TASK_ID".json'
        return (
            "#!/bin/sh\n"
            f"export PYTHONPATH={package}\n"
            f"exec {PYTHON} -B -m icwafer.study.slurm_task {share}\n"
        )


def _largest_array() -> int:
    match = re.search(r"MaxArraySize\s*=\s*(\d+)", _slurm("scontrol", "show", "config"))
    return int(match[1]) - 1 if match else 1000


def _is_active(array: str) -> bool:
    """Whether tasks wait or run; True as well while the controller does not answer."""
    done = subprocess.run(
        ["squeue", "--noheader", f"--jobs={array}", "--format=%T"], capture_output=True, text=True
    )
    if done.returncode != 0:
        return "Invalid job id" not in done.stderr
    return bool(done.stdout.strip())


def _slurm(*command: str, given: str | None = None) -> str:
    """Runs a command of Slurm's. Raises IcwaferError with what it says."""
    done = subprocess.run(command, input=given, capture_output=True, text=True)
    if done.returncode != 0 and command[0] != "scancel":
        reason = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise IcwaferError(f"{command[0]}: {reason.removeprefix(f'{command[0]}: error: ')}")
    return done.stdout.strip()
