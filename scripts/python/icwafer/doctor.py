# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks everything that building and rendering depend on, and says how to mend what fails."""

from __future__ import annotations

import platform
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from icwafer import build, packages, paths
from icwafer.assets.plan import KINDS, installed_folder
from icwafer.errors import IcwaferError
from icwafer.source import host_edits

#: Blender is started with this; it fails if the node or the add-on is not in it.
PROBE = "import bpy; bpy.types.ShaderNodeBsdfICWafer; bpy.types.MESH_OT_ic_die_add"


@dataclass(frozen=True)
class Finding:
    """What a check found: `mend` says what to do and is empty if all is well."""

    subject: str
    text: str
    mend: str = ""

    def __str__(self) -> str:
        return (
            f"FAIL  {self.subject}: {self.text}; {self.mend}"
            if self.mend
            else f"ok    {self.subject}: {self.text}"
        )


def check_system() -> Finding:
    """Debian 12 with its own Python."""
    try:
        release = platform.freedesktop_os_release()
    except OSError:
        release = {}
    name = release.get("PRETTY_NAME", "an unknown system")
    fits = release.get("ID") == "debian" and release.get("VERSION_ID") == "12"
    text = f"{name}, Python {platform.python_version()}"
    return Finding("system", text, "" if fits else "use a Debian 12 machine or container")


def check_packages(subject: str, *purposes: str) -> Finding:
    """All packages of some purposes are installed."""
    needed = packages.needed(*purposes)
    missing = packages.missing(needed)
    if missing:
        mend = f"run as root: apt-get install --no-install-recommends {' '.join(missing)}"
        return Finding(subject, f"{len(missing)} Debian packages are missing", mend)
    return Finding(subject, f"all {len(needed)} Debian packages are installed")


def check_compiler_cache() -> Finding:
    """ccache is optional."""
    path = shutil.which("ccache")
    return Finding("compiler cache", path or "no ccache; builds work, rebuilds take longer")


def check_space() -> Finding:
    """Room for a build, or for going on with the one that is there."""
    free = build.free_gb(paths.REPOSITORY)
    needed = 1.0 if paths.BLENDER.exists() else build.SPACE_GB["blender"]
    text = f"{free:.0f} GB free"
    mend = "" if free >= needed else f"make room: {needed:g} GB are needed"
    return Finding("disk", text, mend)


def check_edits(tree: Path, host: Path, repository: Path) -> Finding:
    """The host's source is there, and our edits in it are complete and up to date."""
    subject = "source edits"
    mend = "run scripts/icwafer build blender"
    if not tree.is_dir():
        return Finding(subject, f"{tree} is not there yet", mend)
    try:
        state = host_edits.verify(tree, host, repository)
    except host_edits.HostEditError as error:
        return Finding(subject, str(error), f"remove {tree} if nothing else helps, and {mend}")
    text = f"{state.value} in {tree}"
    return Finding(subject, text, "" if state is host_edits.State.CURRENT else mend)


def check_program(subject: str, built: Path, installed: Path, target: str) -> Finding:
    """A program is built, and the installed one is not older."""
    mend = f"run scripts/icwafer build {target}"
    if not built.is_file():
        started = (built.parent.parent / "build.ninja").is_file()
        return Finding(subject, "half built" if started else "not built yet", mend)
    if not installed.is_file():
        return Finding(subject, "built, but not installed", mend)
    # An installed file has its time in whole seconds.
    if installed.stat().st_mtime < int(built.stat().st_mtime):
        return Finding(subject, f"{installed} is older than the build", mend)
    return Finding(subject, str(installed))


def check_core() -> Finding:
    """The tests of the material are configured and built."""
    programs = list((paths.BUILD / "core" / "tests" / "shaders").glob("test_*"))
    if any(path.is_file() for path in programs):
        return Finding("core", f"built in {paths.BUILD / 'core'}")
    return Finding("core", "not built yet", "run scripts/icwafer build core")


def check_start() -> Finding:
    """Blender starts without a window, its Python works, and it knows node and add-on."""
    mend = "run scripts/icwafer build blender; if that does not help, remove build/install first"
    blender = paths.BLENDER
    command = [blender, "-b", "--factory-startup", "--python-exit-code", "1"]
    try:
        done = subprocess.run(
            [*map(str, command), "--python-expr", PROBE],
            capture_output=True,
            text=True,
            timeout=120,
        )
    except OSError as error:
        return Finding("Blender's start", f"{blender}: {error.strerror}", mend)
    except subprocess.TimeoutExpired:
        return Finding("Blender's start", f"{blender} hangs", mend)
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines()
        reason = lines[-1] if lines else f"exit status {done.returncode}"
        return Finding("Blender's start", f"{blender}: {reason}", mend)
    return Finding("Blender's start", "starts, and has the node and the add-on")


def check_assets() -> Finding:
    """The asset library is there; whether it is up to date, its own command finds out."""
    folder = installed_folder()
    missing = [kind for kind in KINDS if not (folder / f"{kind}.blend").is_file()]
    if missing:
        return Finding("asset library", f"no {missing[0]} in {folder}", "run scripts/icwafer assets")
    return Finding("asset library", f"{', '.join(KINDS)} in {folder}")


def checks() -> list[Callable[[], Finding]]:
    """All checks, in the order in which things depend on each other."""
    purposes = ["base", "images", "core", "host", *(["full"] if build.is_full({}) else [])]
    bin_folder = paths.HOST_BINARY / "bin"
    return [
        check_system,
        lambda: check_packages("packages to build", *purposes),
        lambda: check_packages("packages to test", "layout", "import", "test"),
        check_compiler_cache,
        check_space,
        lambda: check_edits(paths.host_source(), paths.HOST, paths.REPOSITORY),
        check_core,
        lambda: check_program("cycles", bin_folder / "cycles", paths.CYCLES, "blender"),
        lambda: check_program("Blender", bin_folder / "blender", paths.BLENDER, "blender"),
        check_start,
        check_assets,
    ]


def examine(check: Callable[[], Finding]) -> Finding:
    """Runs a check; one that cannot be made is a finding too."""
    try:
        return check()
    except (IcwaferError, host_edits.HostEditError, OSError) as error:
        return Finding("check", str(error), "mend this and run doctor again")
