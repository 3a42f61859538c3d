# SPDX-License-Identifier: GPL-2.0-or-later
"""From a study file to a folder of results."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from icwafer.errors import IcwaferError
from icwafer.progress import Progress, duration
from icwafer.study import document, fields, local, plan
from icwafer.study.document import Assignment, Study
from icwafer.study.local import Outcome
from icwafer.study.order import Order
from icwafer.study.plan import Job, Plan
from icwafer.study.store import Store
from icwafer.study.workers import Reply, ask
from icwafer.suggest import nearest

#: What a path costs where nothing has been measured yet, in seconds of all cores: the picture
#: `full` has 66 million paths and takes 75 s on two cores.
SECONDS_PER_PATH = 1.15e-6
#: What a job costs besides its paths, and Blender's start: measured 0.1 s and 0.9 s.
JOB_S, START_S = 0.1, 1.0

#: Renders jobs of a study into a store: `local.render` for an order, or a cluster.
Engine = Callable[[Sequence[Job], Plan, Store, Order], Iterator[Outcome]]


@dataclass(frozen=True)
class Summary:
    """How a study went: how many images were there before, were made, and which ones failed."""

    present: int
    rendered: int
    failed: tuple[Outcome, ...]


def prepare(order: Order) -> Plan:
    """Reads a study and makes its jobs; nothing is rendered.

    Raises IcwaferError for anything that is wrong with the study. What only Blender knows (the
    names that its build has, and what is in a .blend file) it is asked for.
    """
    if order.study.suffix == ".exr":
        made = plan.of_image(order.study, order.settings, order.key)
    else:
        study = document.overridden(document.read(order.study), list(order.settings))
        made = plan.make(study, order.key, _needs(study, order))
    for wanted in order.only:
        known = [job.id for job in made.jobs]
        if wanted not in known:
            raise IcwaferError(f"--only {wanted}: no such job; {nearest(wanted, known[:1000])}")
    return made


def missing(order: Order, made: Plan) -> list[Job]:
    """The wanted jobs whose results are not there, or of other settings or another program."""
    store, wanted = Store(order.folder), set(order.only)
    return [
        job for job in made.jobs if (not wanted or job.id in wanted) and not store.is_finished(job)
    ]


def render(order: Order, made: Plan, engine: Engine) -> Summary:
    """Renders what is missing, with progress on the screen.

    Raises IcwaferError where the study is not possible in this Blender or nothing can be rendered
    at all; a job that fails is only part of the summary.
    """
    store = Store(order.folder)
    with store.locked():
        store.expect_study(order.study.name)
        store.arrange(made.jobs)
        jobs = missing(order, made)
        if jobs:
            judge(order, made)
        _write_study(store, order, made)
        wanted = len(order.only) or len(made.jobs)
        failed = []
        progress = _Progress(f"Rendering {made.study.name}", jobs)
        try:
            for outcome in engine(jobs, made, store, order):
                progress.count(outcome.job)
                if outcome.error:
                    failed.append(outcome)
        finally:
            store.clean()
        progress.end(failed)
        return Summary(wanted - len(jobs), len(jobs) - len(failed), tuple(failed))


def render_here(jobs: Sequence[Job], made: Plan, store: Store, order: Order) -> Iterator[Outcome]:
    """The engine that uses this machine."""
    store.clean()
    name = made.study.name
    yield from local.render(
        jobs,
        store,
        order.renderer,
        lambda job: order.attributes(job, name),
        order.facts,
        store.lights(made.jobs),
    )


def judge(order: Order, made: Plan) -> None:
    """Has Blender judge the values that it alone can judge, one scene for each of them.

    Raises IcwaferError that names the line of the one that it refuses.
    """
    tried = _to_be_tried(made)
    if not tried:
        return
    requests = [{"do": "check", "scene": job.scene} for job in tried]
    replies = iter(ask(order.renderer, requests))
    next(replies)
    for job, reply in zip(tried, replies):
        if "error" in reply:
            raise _refusal(made, job, reply)


def estimate_s(order: Order, made: Plan, jobs: Sequence[Job]) -> float | None:
    """How long some jobs will take, from those that are done; None if that is not known."""
    store = Store(order.folder)
    measured = [store.facts(job) for job in made.jobs[:1000]]
    paths = seconds = 0.0
    for facts in measured:
        if facts.get("status") == "done" and facts.get("rendered"):
            paths += facts["size"][0] * facts["size"][1] * facts["samples"]
            seconds += max(facts["seconds"] - JOB_S, 0.0)
    rate = seconds / paths / order.workers if paths else SECONDS_PER_PATH
    if any("render.size" not in job.scene for job in jobs):
        return None
    starts = START_S * (len(jobs) if order.isolate else order.workers)
    there = store.lights(made.jobs)
    rendered = {job.light_key: job for job in jobs if job.light_key not in there}
    cost = sum(map(paths_of, rendered.values())) * rate
    return cost + (starts + JOB_S * len(jobs)) / order.workers


def paths_of(job: Job) -> int:
    """Pixels times samples; 0 where only the .blend file knows."""
    width, height = job.scene.get("render.size", (0, 0))
    return width * height * job.scene.get("render.samples", 0)


class _Progress:
    """The line on the screen: how many are done, and how long the rest will take.

    Jobs count with their paths, and a little more for what each one costs besides.
    """

    def __init__(self, title: str, jobs: Sequence[Job]) -> None:
        self._line = Progress(title)
        self._total, self._done = len(jobs), 0
        self._all = sum(map(self._cost, jobs))
        self._spent = 0.0
        self._begin = time.monotonic()

    @staticmethod
    def _cost(job: Job) -> float:
        return paths_of(job) * SECONDS_PER_PATH + JOB_S

    def count(self, job: Job) -> None:
        self._done += 1
        self._spent += self._cost(job)
        rest = (self._all - self._spent) / self._spent
        self._line.left = duration((time.monotonic() - self._begin) * max(rest, 0.0))
        self._line.feed(f"[{self._done}/{self._total}]")
        self._line.tick()

    def end(self, failed: Sequence[Outcome]) -> None:
        if self._total:
            good = self._total - len(failed)
            self._line.end(f"{good} of {self._total} images done" if failed else "done")


def _needs(study: Study, order: Order) -> Mapping[str, Sequence[str]]:
    """Which other files the .blend files of a study need. Blender has to open them for that."""
    steps = [step for axis in study.axes for step in axis.steps]
    assignments = [*study.scene, *(a for step in steps for a in step.assignments)]
    opened = {a.value: a for a in assignments if a.setting == fields.BLEND}
    if not opened:
        return {}
    requests = [{"do": "check", "scene": {fields.BLEND: path}} for path in opened]
    replies = ask(order.renderer, requests)
    next(replies)
    needs = {}
    for path, reply in zip(opened, replies):
        if "error" in reply:
            raise opened[path].error(reply["error"])
        needs[path] = [name for name in reply["needs"] if Path(name).is_file()]
    return needs


def _is_judged(assignment: Assignment) -> bool:
    """Whether only Blender can tell if the value is allowed."""
    setting = assignment.setting
    return bool(re.fullmatch(r"blend|data\..*|view\.(transform|look)|node\.[a-z_]+", setting))


def _to_be_tried(made: Plan) -> list[Job]:
    """The first job, if Blender has to judge what all have in common, and the first job of each
    step that it has to judge."""
    first: dict[tuple[str, str], Job] = {}
    for job in made.jobs:
        for axis, label in job.labels.items():
            first.setdefault((axis, str(label)), job)
    tried: dict[str, Job] = {}
    if any(map(_is_judged, made.study.scene)):
        tried[made.jobs[0].id] = made.jobs[0]
    for axis in made.study.axes:
        for step in axis.steps:
            if any(map(_is_judged, step.assignments)):
                job = first[axis.name, str(step.label)]
                tried[job.id] = job
    return list(tried.values())


def _refusal(made: Plan, job: Job, reply: Reply) -> IcwaferError:
    """The error that names the line of what Blender has refused."""
    assignments = list(made.study.scene)
    for axis in made.study.axes:
        for step in axis.steps:
            if step.label == job.labels[axis.name]:
                assignments += step.assignments
    for assignment in reversed(assignments):
        if assignment.setting == reply.get("setting"):
            return assignment.error(reply["error"])
    return IcwaferError(f"{made.study.document.path}: job {job.id}: {reply['error']}")


def _write_study(store: Store, order: Order, made: Plan) -> None:
    study = made.study
    axes: Iterable[dict] = (
        {"name": axis.name, "unit": axis.unit, "values": [step.label for step in axis.steps]}
        for axis in study.axes
    )
    store.write_study(
        {
            "name": study.name,
            "source": order.study.name,
            "description": study.description,
            "axes": list(axes),
            "reference": made.reference,
            "jobs": [job.id for job in made.jobs],
            "versions": dict(order.versions),
            "command": order.command(),
        }
    )
