# SPDX-License-Identifier: GPL-2.0-or-later
"""Worker processes: programs that take one request after the other, so that a start is paid once.

A worker is any command. Its last argument is the number of a file descriptor to reply to; requests
come on its standard input, one JSON object in each line, and so go the replies. The first reply
says {"ready": {…}}, what the worker is; then there is one for each request. At the end of its
input a worker ends.
"""

from __future__ import annotations

import json
import os
import selectors
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from types import TracebackType
from typing import IO, Any

from icwafer.errors import IcwaferError
from icwafer.progress import first_error

Reply = Mapping[str, Any]


@dataclass(frozen=True)
class Renderer:
    """How jobs are rendered.

    command: of a worker, without its last argument. workers: how many at a time. isolate: a new
    worker for every job. timeout_s: how long a worker may take for its start and for each request.
    """

    command: tuple[str, ...]
    workers: int = 1
    isolate: bool = False
    timeout_s: float = 3600.0


class Worker:
    """One process. `task` is what its owner has given it to do; `done` counts what it has done."""

    def __init__(self, renderer: Renderer) -> None:
        self.task: Any = None
        self.done = 0
        self.ready = False
        self.leaving = False
        self._timeout_s = renderer.timeout_s
        self._pending = b""
        self._log: IO[bytes] = tempfile.TemporaryFile()
        self.replies, writing = os.pipe()
        try:
            self._process = subprocess.Popen(
                [*renderer.command, str(writing)],
                stdin=subprocess.PIPE,
                stdout=self._log,
                stderr=subprocess.STDOUT,
                pass_fds=(writing,),
                start_new_session=True,
            )
        except OSError as error:
            os.close(self.replies)
            raise IcwaferError(
                f"{renderer.command[0]}: {error.strerror}; scripts/icwafer doctor checks it"
            ) from None
        finally:
            os.close(writing)
        self._deadline = time.monotonic() + self._timeout_s

    def send(self, request: Mapping[str, Any]) -> None:
        """Sends a request; that a worker has crashed is seen by its replies."""
        self._deadline = time.monotonic() + self._timeout_s
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()

    def dismiss(self) -> None:
        """Tells it that no more comes; it ends by itself."""
        self.leaving = True
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.close()

    def is_late(self) -> bool:
        """Whether it has something to do and takes too long."""
        busy = self.task is not None or not self.ready
        return busy and time.monotonic() > self._deadline

    def kill(self) -> None:
        """Ends it and all that it started, now."""
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)

    def read(self) -> list[Reply] | None:
        """The replies that have come, to be called when there are any; None at their end."""
        data = os.read(self.replies, 1 << 20)
        if not data:
            return None
        *lines, self._pending = (self._pending + data).split(b"\n")
        return [json.loads(line) for line in lines]

    def bury(self) -> str:
        """Waits for its end and returns how it came: the signal, or the error that it wrote."""
        late = self.is_late()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=10 if not late else 0)
        self.kill()
        status = self._process.wait()
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.close()
        os.close(self.replies)
        self._log.seek(0)
        written = self._log.read().decode(errors="replace")
        self._log.close()
        if late:
            return f"took longer than {self._timeout_s:g} s"
        if status < 0:
            return f"crashed ({signal.Signals(-status).name})"
        return f"ended with status {status}: {first_error(written)}"


class Crew:
    """The workers that run at present; none is left when it is."""

    def __init__(self, renderer: Renderer) -> None:
        self._renderer = renderer
        self._selector = selectors.DefaultSelector()
        self.workers: list[Worker] = []

    def __enter__(self) -> Crew:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        _: TracebackType | None,
    ) -> None:
        for worker in self.workers:
            if kind is None:
                worker.dismiss()
            else:
                worker.kill()
        for worker in list(self.workers):
            self.part_with(worker)
        self._selector.close()

    def staff(self, wanted: int) -> None:
        """Starts workers so that `wanted` things can be done, as far as there may be so many."""
        active = sum(not worker.leaving for worker in self.workers)
        for _ in range(min(self._renderer.workers, wanted) - active):
            worker = Worker(self._renderer)
            self.workers.append(worker)
            self._selector.register(worker.replies, selectors.EVENT_READ, worker)

    def idle(self) -> list[Worker]:
        """Workers that wait for something to do."""
        return [w for w in self.workers if w.ready and not w.leaving and w.task is None]

    def replies(self) -> Iterator[tuple[Worker, Reply | str]]:
        """Waits a moment, and yields what workers reply; a text is how one has ended.

        A worker that has ended is no longer one of the crew.
        """
        for worker in self.workers:
            if worker.is_late():
                worker.kill()
        for key, _ in self._selector.select(timeout=0.5):
            worker: Worker = key.data
            replies = worker.read()
            if replies is None:
                end = self.part_with(worker)
                if not worker.leaving:
                    yield worker, end
            for reply in replies or []:
                if "ready" in reply:
                    worker.ready = True
                yield worker, reply

    def part_with(self, worker: Worker) -> str:
        """Waits for a worker's end and returns how it came."""
        self._selector.unregister(worker.replies)
        self.workers.remove(worker)
        return worker.bury()


def ask(renderer: Renderer, requests: Sequence[Mapping[str, Any]]) -> Iterator[Reply]:
    """What a worker says of itself at its start, and its replies to some requests.

    Raises IcwaferError where it ends instead.
    """
    with Crew(renderer) as crew:
        crew.staff(1)
        (worker,) = crew.workers
        for request in (None, *requests):
            if request is not None:
                worker.task = request
                worker.send(request)
            answer: list[tuple[Worker, Reply | str]] = []
            while not answer:
                answer = list(crew.replies())
            reply = answer[0][1]
            if isinstance(reply, str):
                raise IcwaferError(f"the renderer {reply}; scripts/icwafer doctor checks it")
            yield reply
