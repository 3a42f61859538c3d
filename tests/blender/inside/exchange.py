# SPDX-License-Identifier: GPL-2.0-or-later
"""How a script inside Blender gets parameters from a test and answers (see `host.run_inside`)."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any


def parameters() -> dict[str, Any]:
    """What the test passed: the JSON object in the file whose name follows `--`."""
    return json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())


def report(facts: dict[str, Any]) -> None:
    """Answer the test with one JSON object."""
    Path(parameters()["report"]).write_text(json.dumps(facts))
