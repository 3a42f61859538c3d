# SPDX-License-Identifier: GPL-2.0-or-later
"""One task of a Slurm array, on a node: renders its share of a study.

python3 -m icwafer.study.slurm_task SHARE.json
"""

from __future__ import annotations

import dataclasses
import os
import sys
from pathlib import Path

from icwafer.errors import IcwaferError
from icwafer.study import local
from icwafer.study.slurm import Share
from icwafer.study.store import Store


def main(path: Path) -> int:
    """Renders what is missing of a share, with as many threads as Slurm gives to the task."""
    share = Share.read(path)
    threads = int(os.environ.get("SLURM_CPUS_PER_TASK", 1))
    order = dataclasses.replace(share.order, threads=threads)
    store = Store(order.folder)
    missing = [job for job in share.jobs if not store.is_finished(job)]
    try:
        for outcome in local.render(
            missing,
            store,
            order.renderer,
            lambda job: order.attributes(job, share.study),
            lambda job: {**order.facts(job), "array": share.array},
            store.lights(share.jobs),
        ):
            print(outcome.job.id, outcome.error or "done", flush=True)
    except IcwaferError as error:
        print(f"icwafer: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
