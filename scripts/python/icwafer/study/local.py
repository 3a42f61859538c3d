# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders jobs with worker processes on this machine (see `icwafer.study.workers`).

A crash costs the job that the worker was at, and a new worker goes on. A job whose worker crashed
after it had done others is tried once more in a fresh one: no job suffers from those before it.

Of jobs that share their light one is rendered; the others wait for it and take over its linear
image.

    engine:  {"do": "render", "folder": …, "scene": {…}, "attributes": {…}, "light": …}
                                             light: a linear image of the same light, or none
    worker:  {"seconds": …, …}               facts for job.json; the images and the log are in
                                             the folder
        or:  {"error": "…"}                  this job cannot be rendered
        or:  {"error": "…", "fatal": true}   no job can be: the disk is full
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from icwafer.errors import IcwaferError
from icwafer.study.plan import Job
from icwafer.study.store import LIGHT, Store
from icwafer.study.workers import Crew, Renderer, Reply, Worker

#: A worker is replaced after so many jobs, whatever may have piled up in it.
JOBS_OF_A_WORKER = 500


@dataclass(frozen=True)
class Outcome:
    """How a job ended; `error` is empty if it went well."""

    job: Job
    error: str


@dataclass(frozen=True)
class _Attempt:
    job: Job
    part: Path
    again: bool


def render(
    jobs: Sequence[Job],
    store: Store,
    renderer: Renderer,
    attributes: Callable[[Job], Mapping[str, str]],
    facts: Callable[[Job], Mapping[str, Any]],
    lights: Mapping[str, Path],
) -> Iterator[Outcome]:
    """Renders jobs and yields how each ended, as they end.

    lights: linear images that are there, by the keys of their light. attributes: the metadata of a job's EXR file. facts: what its `job.json` says besides what the
    worker reports. Raises IcwaferError where no job can be rendered (the renderer does not start,
    the disk is full); what is finished then stays.
    """
    waiting = deque((job, False) for job in jobs)
    lights = dict(lights)
    with Crew(renderer) as crew:
        while waiting or any(worker.task for worker in crew.workers):
            crew.staff(len(waiting) + sum(worker.task is not None for worker in crew.workers))
            for worker in crew.idle():
                rendered = {other.task.job.light_key for other in crew.workers if other.task}
                if chosen := _next(waiting, rendered - lights.keys()):
                    job, again = chosen
                    worker.task = _Attempt(job, store.part(job), again)
                    light = lights.get(job.light_key)
                    worker.send(_request(worker.task, attributes(job), light))
            for worker, reply in crew.replies():
                attempt: _Attempt | None = worker.task
                if isinstance(reply, str):
                    if attempt is None:
                        raise IcwaferError(
                            f"the renderer {reply}; scripts/icwafer doctor checks it"
                        )
                    if worker.done and not attempt.again:
                        waiting.appendleft((attempt.job, True))
                        continue
                    reply = {"error": f"the renderer {reply}"}
                if attempt is not None:
                    outcome = _finish(store, attempt, reply, facts(attempt.job))
                    if not outcome.error:
                        lights[attempt.job.light_key] = store.jobs / attempt.job.id / LIGHT
                    yield outcome
                    _release(worker, renderer)


def _next(waiting: deque[tuple[Job, bool]], rendered: Set[str]) -> tuple[Job, bool] | None:
    """Takes the first job out whose light is not just being rendered."""
    for place, (job, again) in enumerate(waiting):
        if job.light_key not in rendered:
            del waiting[place]
            return job, again
    return None


def _request(
    attempt: _Attempt, attributes: Mapping[str, str], light: Path | None
) -> Mapping[str, Any]:
    return {
        "do": "render",
        "folder": str(attempt.part),
        "scene": attempt.job.scene,
        "attributes": dict(attributes),
        "light": light and str(light),
    }


def _finish(store: Store, attempt: _Attempt, reply: Reply, facts: Mapping[str, Any]) -> Outcome:
    if reply.get("fatal"):
        raise IcwaferError(f"{reply['error']}; then run the same command again to go on")
    error = reply.get("error", "")
    ended = {"status": "failed" if error else "done", "error": error or None}
    store.commit(attempt.job, attempt.part, {**facts, **reply, **ended})
    return Outcome(attempt.job, error)


def _release(worker: Worker, renderer: Renderer) -> None:
    """The worker's job is done: it may take another, or has done its share."""
    worker.task = None
    worker.done += 1
    if renderer.isolate or worker.done >= JOBS_OF_A_WORKER:
        worker.dismiss()
