#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Stands in for Blender in tests of the engine: takes the same command line and requests.

Its images are bytes made from the settings, so that the same settings give the same files. The
exposure tells it what to do: 1 crash, 2 fail, 3 hang, 4 crash unless it is the worker's first job;
ICWAFER_STAND_IN_S is how long a job takes.
"""

import errno
import hashlib
import json
import os
import signal
import sys
import time
from pathlib import Path

CRASH, FAIL, HANG, CRASH_LATER = 1.0, 2.0, 3.0, 4.0
EXR_BYTES, PNG_BYTES = 30_000, 10_000


def image(settings: dict, size: int) -> bytes:
    seed = hashlib.sha256(json.dumps(settings).encode()).digest()
    return (seed * (size // len(seed) + 1))[:size]


def render(request: dict, number: int) -> dict:
    folder, scene = Path(request["folder"]), request["scene"]
    behaviour = scene.get("view.exposure")
    (folder / "log.txt").write_text(f"job {number} of worker {os.getpid()}\n")
    if behaviour == CRASH or (behaviour == CRASH_LATER and number > 0):
        os.kill(os.getpid(), signal.SIGSEGV)
    if behaviour == FAIL:
        return {"error": "there is no camera"}
    if behaviour == HANG:
        time.sleep(3600)
    try:
        (folder / "image.exr").write_bytes(image(scene, EXR_BYTES))
        time.sleep(float(os.environ.get("ICWAFER_STAND_IN_S", 0)))
        (folder / "image.png").write_bytes(image(scene, PNG_BYTES))
    except OSError as error:
        full = error.errno in (errno.ENOSPC, errno.EFBIG)
        return {"error": f"{error.filename}: {error.strerror}", "fatal": full}
    return {
        "seconds": 0.2,
        "rendered": request["light"] is None,
        "samples": scene["render.samples"],
        "seed": scene["render.seed"],
        "size": scene["render.size"],
        "view_transform": scene["view.transform"],
        "threads": int(sys.argv[sys.argv.index("--threads") + 1]),
    }


def check(request: dict) -> dict:
    scene = request["scene"]
    if scene.get("node.model") == "PHYSICAL":
        return {"error": "is not possible here", "setting": "node.model"}
    return {"needs": []}


def main() -> None:
    if sys.argv[1:] == ["--version"]:
        print("Blender 0 (stand-in)")
        return
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    with os.fdopen(int(sys.argv[-1]), "w") as replies:
        print(json.dumps({"ready": {"version": "stand-in"}}), file=replies, flush=True)
        for number, line in enumerate(sys.stdin):
            request = json.loads(line)
            reply = check(request) if request["do"] == "check" else render(request, number)
            print(json.dumps(reply), file=replies, flush=True)


if __name__ == "__main__":
    main()
