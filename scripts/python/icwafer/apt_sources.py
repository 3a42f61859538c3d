# SPDX-License-Identifier: GPL-2.0-or-later
"""Where this machine gets Debian from, read from its own apt configuration.

Only entries that can hold the source package of a Debian release are of interest: a suite of that
release, component `main`. Both formats are read (sources.list(5)): one line each in `*.list`, and
stanzas in `*.sources`.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")


@dataclass(frozen=True)
class Origin:
    """A mirror with a suite of Debian; `options` are apt's, such as `signed-by=FILE`."""

    uri: str
    suite: str
    options: tuple[str, ...] = ()

    def deb_src_line(self) -> str:
        """The line of a sources file that gives this origin's source packages."""
        options = f"[{' '.join(self.options)}] " if self.options else ""
        return f"deb-src {options}{self.uri} {self.suite} main"


def configured_files() -> list[Path]:
    """The files that apt reads its sources from on this machine."""
    names: dict[str, str] = {}
    for kind, name in (("f", "sourcelist"), ("d", "sourceparts")):
        query = ["apt-config", "shell", "result", f"Dir::Etc::{name}/{kind}"]
        words = subprocess.run(query, capture_output=True, text=True, check=True).stdout
        names[name] = words.partition("=")[2].strip().strip("'\"")
    parts = Path(names["sourceparts"])
    return [
        Path(names["sourcelist"]),
        *sorted(path for path in parts.glob("*") if path.suffix in (".list", ".sources")),
    ]


def origins(files: list[Path], suites: tuple[str, ...]) -> list[Origin]:
    """Origins of Debian's `main` for some suites, without repetition, in the order of the files.

    Where the machine names none, Debian's own address stands in.
    """
    found: dict[Origin, None] = {}
    for path in files:
        if path.is_file():
            text = path.read_text(encoding="utf-8", errors="replace")
            read = _one_line_entries if path.suffix == ".list" else _stanzas
            for entry in read(text):
                if entry.suite in suites:
                    found[entry] = None
    default = Origin("http://deb.debian.org/debian", suites[0], (f"signed-by={KEYRING}",))
    return list(found) or [default]


def _one_line_entries(text: str) -> Iterator[Origin]:
    for line in text.splitlines():
        words = line.partition("#")[0].split()
        if not words or words[0] not in ("deb", "deb-src"):
            continue
        options: list[str] = []
        if len(words) > 1 and words[1].startswith("["):
            close = next((i for i, word in enumerate(words) if word.endswith("]")), 0)
            options = " ".join(words[1 : close + 1]).strip("[] ").split()
            words = [words[0], *words[close + 1 :]]
        if len(words) > 3 and "main" in words[3:]:
            kept = tuple(option for option in options if _matters(option.partition("=")[0]))
            yield Origin(words[1].rstrip("/"), words[2], kept)


def _stanzas(text: str) -> Iterator[Origin]:
    for stanza in text.split("\n\n"):
        fields = _fields(stanza)
        if fields.get("enabled", "yes").lower() in ("no", "false"):
            continue
        if "main" not in fields.get("components", "").split():
            continue
        options = []
        for name in ("signed-by", "trusted", "check-valid-until"):
            value = fields.get(name, "")
            if value and "BEGIN PGP" not in value:  # a key in the file itself has no path
                options.append(f"{name}={value}")
        for uri in fields.get("uris", "").split():
            for suite in fields.get("suites", "").split():
                yield Origin(uri.rstrip("/"), suite, tuple(options))


def _fields(stanza: str) -> dict[str, str]:
    """A stanza's fields, names in lower case; continued lines are joined, comments left out."""
    fields: dict[str, str] = {}
    name = ""
    for line in stanza.splitlines():
        if line.startswith("#"):
            continue
        if line[:1].isspace():
            fields[name] = f"{fields.get(name, '')} {line.strip()}".strip()
        elif ":" in line:
            name, _, value = line.partition(":")
            name = name.strip().lower()
            fields[name] = value.strip()
    return fields


def _matters(option: str) -> bool:
    return option.lower() in ("signed-by", "trusted", "check-valid-until")
