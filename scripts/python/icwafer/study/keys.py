# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of jobs: the same key, the same result.

A key is a SHA-256 over the settings of the scene, the content of the files that they name, the
scripts that build the scene, and the program that renders it. The key of the light leaves out how
the light is shown: jobs that differ in their view transforms only share one linear image.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from icwafer.dependencies import file_hash, scripts_hash
from icwafer.study import fields

#: Raised when the same inputs would give another image, or a result's files another form.
FORMAT = 2
WORKER = Path(__file__).with_name("worker.py")

_DIE = "die."
_VIEW = "view."
#: The order of groups matters to a die; the order in which a study names these never does.
_UNORDERED = ("node.", "data.")


class Keys:
    """Makes keys. program: stands for the renderer, the hash of its file. needs: for files that
    scenes name, the files that those need in turn (the textures of a .blend file)."""

    def __init__(self, program: str, needs: Mapping[str, Sequence[str]]) -> None:
        self._constants = f"{FORMAT} {program} {scripts_hash(WORKER)}"
        self._needs = needs

    def of(self, scene: fields.Scene, die: str | None = None) -> tuple[str, str]:
        """The keys of a scene and of its light; `die` is the digest of its die, if known."""
        apart = (_DIE, _VIEW, *_UNORDERED)
        rest = [item for item in scene.items() if not item[0].startswith(apart)]
        rest += sorted(item for item in scene.items() if item[0].startswith(_UNORDERED))
        light = _digest([self._constants, die or self.die(scene), self._with_content(rest)])
        return _digest([light, [i for i in scene.items() if i[0].startswith(_VIEW)]]), light

    def die(self, scene: fields.Scene) -> str:
        """The digest of a scene's die."""
        items = [item for item in scene.items() if item[0].startswith(_DIE)]
        return _digest(self._with_content(items))

    def _with_content(self, items: list[tuple[str, Any]]) -> list[tuple[str, Any]]:
        """The same, with the content of files in place of their names."""
        return [
            (name, self._content(value) if name in fields.FILES and value else value)
            for name, value in items
        ]

    def _content(self, path: str) -> list[str]:
        return [file_hash(Path(file)) for file in (path, *self._needs.get(path, ()))]


def _digest(value: Any) -> str:
    return hashlib.sha256(json.dumps(value).encode()).hexdigest()
