# SPDX-License-Identifier: GPL-2.0-or-later
"""A real Slurm cluster on this machine, for a test: munged, slurmctld and two slurmd of one core.

It needs Debian's packages munge, slurmctld, slurmd and slurm-client. Nothing outside its folder is
touched, and its ports are ones that are free. Everything runs as the present user, but for munged,
which does not like to be root.
"""

from __future__ import annotations

import contextlib
import getpass
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

NODES = ("node1", "node2")


def wait_until(condition: Callable[[], bool], seconds: float, what: str) -> None:
    """Waits for a condition; fails with what was waited for."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds:g} s in vain: {what}")
        time.sleep(0.1)


class Cluster:
    """The running daemons. `environment` makes Slurm's commands find them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.config = folder / "slurm.conf"
        self.environment = {"SLURM_CONF": str(self.config)}
        self._processes: dict[str, subprocess.Popen[bytes]] = {}

    def start(self) -> None:
        self._munge()
        ports = _free_ports(1 + len(NODES))
        nodes = "".join(
            f"NodeName={name} NodeHostname={socket.gethostname()} NodeAddr=127.0.0.1 "
            f"Port={port} CPUs=1 State=UNKNOWN\n"
            for name, port in zip(NODES, ports[1:])
        )
        settings = {
            "ClusterName": "test",
            "SlurmctldHost": f"{socket.gethostname()}(127.0.0.1)",
            "SlurmctldPort": ports[0],
            "SlurmUser": getpass.getuser(),
            "SlurmdUser": getpass.getuser(),
            "AuthInfo": f"socket={self.folder}/munge/socket",
            "StateSaveLocation": self.folder / "state",
            "SlurmdSpoolDir": f"{self.folder}/spool-%n",
            "SlurmctldPidFile": self.folder / "slurmctld.pid",
            "SlurmdPidFile": f"{self.folder}/%n.pid",
            "SlurmctldLogFile": self.folder / "slurmctld.log",
            "SlurmdLogFile": f"{self.folder}/%n.log",
            "ProctrackType": "proctrack/linuxproc",
            "TaskPlugin": "task/none",
            "MpiDefault": "none",
            "JobAcctGatherType": "jobacct_gather/none",
            "SelectType": "select/cons_tres",
            "SelectTypeParameters": "CR_CPU",
            # A dead node is noticed within seconds, and its jobs wait again.
            "SlurmdTimeout": 4,
            "JobRequeue": 1,
            "ReturnToService": 2,
            "RebootProgram": "/bin/true",
        }
        text = "".join(f"{name}={value}\n" for name, value in settings.items())
        self.config.write_text(
            f"{text}{nodes}PartitionName=all Nodes={','.join(NODES)} Default=YES State=UP\n"
        )
        (self.folder / "state").mkdir()
        self._run("slurmctld", "slurmctld", "-D", "-f", self.config)
        for node in NODES:
            self.start_node(node)
        wait_until(self._is_up, 30, f"the nodes; logs are in {self.folder}")

    def start_node(self, node: str) -> None:
        (self.folder / f"spool-{node}").mkdir(exist_ok=True)
        self._run(node, "slurmd", "-D", "-N", node, "-f", self.config)

    def kill_node(self, node: str) -> None:
        """As if its plug was pulled: the daemon and all that it runs."""
        for process in _family(self._processes[node].pid):
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        self._processes.pop(node).wait()

    def running_on(self, node: str) -> bool:
        """Whether a job runs there."""
        return bool(self.slurm("squeue", "--noheader", "--states=running", f"--nodelist={node}"))

    def slurm(self, *command: str) -> str:
        done = subprocess.run(
            command, env={**os.environ, **self.environment}, capture_output=True, text=True
        )
        return done.stdout.strip()

    def stop(self) -> None:
        for name in list(self._processes):
            self.kill_node(name)

    def _is_up(self) -> bool:
        return self.slurm("sinfo", "--noheader", "--Node", "--format=%t").split() == [
            "idle"
        ] * len(NODES)

    def _munge(self) -> None:
        folder = self.folder / "munge"
        folder.mkdir()
        key = folder / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        user = "munge" if os.geteuid() == 0 else None
        if user:
            for path in (folder, key):
                shutil.chown(path, user, user)
        names = ("key-file", "socket", "pid-file", "log-file", "seed-file")
        options = [f"--{name}={folder / name.removesuffix('-file')}" for name in names]
        self._run("munged", "munged", "--foreground", *options, user=user)
        wait_until((folder / "socket").exists, 10, f"munged; its log is in {folder}")

    def _run(
        self, name: str, program: str, *arguments: str | Path, user: str | None = None
    ) -> None:
        path = shutil.which(program, path=f"{os.environ['PATH']}:/usr/sbin")
        if path is None:
            raise AssertionError(f"{program} is missing: run scripts/icwafer test, or apt-get")
        with (self.folder / f"{name}.out").open("wb") as log:
            self._processes[name] = subprocess.Popen(
                [path, *map(str, arguments)],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env={**os.environ, **self.environment},
                user=user,
                start_new_session=True,
            )


@contextlib.contextmanager
def cluster() -> Iterator[Cluster]:
    """A cluster that runs until the end of the block."""
    with tempfile.TemporaryDirectory(prefix="icwafer-slurm-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # munged is another user
        running = Cluster(folder)
        try:
            running.start()
            yield running
        finally:
            running.stop()


def _free_ports(count: int) -> list[int]:
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def _family(root: int) -> list[int]:
    """A process and all that came from it, also those that have left its session."""
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError, IndexError):
                stat = (entry / "stat").read_text()
                parents[int(entry.name)] = int(stat.rpartition(")")[2].split()[1])
    found = [root]
    for process in found:
        found += [child for child, parent in parents.items() if parent == process]
    return found
