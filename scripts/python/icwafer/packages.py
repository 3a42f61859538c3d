# SPDX-License-Identifier: GPL-2.0-or-later
"""Debian packages: which ones each purpose needs, which are missing, and their installation."""

from __future__ import annotations

import logging
import os
import shutil
import subprocess
from collections.abc import Iterable

from icwafer import paths, progress
from icwafer.errors import IcwaferError

_log = logging.getLogger(__name__)

#: Packages by purpose. Every build needs "base"; "images" is what reads, compares and labels
#: pictures, also on a machine that builds nothing; "core" are the C++ tests of the material, "host"
#: is Blender, "full" what Debian's package of Blender has beyond that, "layout" makes and draws
#: chips and wafers, "import" reads real chips, "test" are the tests that start Blender, a
#: browser or Slurm.
PURPOSES: dict[str, tuple[str, ...]] = {
    "base": ("cmake", "g++", "ninja-build"),
    "images": (
        "fonts-dejavu-core",
        "python3-numpy",
        "python3-openimageio",
        "python3-pil",
        "python3-pyopencolorio",
    ),
    "core": (
        "clang",
        "libbenchmark-dev",
        "libboost-dev",
        "libclang-rt-14-dev",
        "libgmock-dev",
        "libgtest-dev",
    ),
    "host": tuple(
        """
        ccache dpkg-dev gettext libavcodec-dev libavdevice-dev libavfilter-dev libavformat-dev
        libblosc-dev libboost-filesystem-dev libboost-iostreams-dev
        libboost-locale-dev libboost-regex-dev libboost-system-dev libboost-thread-dev
        libembree-dev libepoxy-dev libfftw3-dev libfontconfig-dev libfreetype-dev libglew-dev
        libgmp-dev libhpdf-dev libjemalloc-dev libjpeg-dev liblzma-dev liblzo2-dev
        libopencolorio-dev libopenexr-dev libopenimageio-dev libopenjp2-7-dev libopenvdb-dev
        libosd-dev libpng-dev libpotrace-dev libpugixml-dev libswscale-dev libtbb-dev libtiff-dev
        libvorbis-dev libwebp-dev libx11-dev libxcursor-dev libxfixes-dev libxi-dev
        libxinerama-dev libxkbcommon-dev libxrandr-dev libxxf86vm-dev libz-dev libzstd-dev
        pkg-config python3-dev python3-requests
        """.split()
    ),
    "full": (
        "libjack-dev",
        "libopenal-dev",
        "libpulse-dev",
        "libsdl2-dev",
        "libsndfile1-dev",
        "libspnav-dev",
        "opencollada-dev",
    ),
    "layout": ("python3-matplotlib",),
    "import": ("klayout",),
    "test": (
        "blender",
        "chromium",
        "chromium-driver",
        "libgl1-mesa-dri",
        "munge",
        "python3-selenium",
        "slurm-client",
        "slurmctld",
        "slurmd",
        "xauth",
        "xvfb",
    ),
}


def needed(*purposes: str) -> list[str]:
    """All packages of some purposes, sorted."""
    return sorted({package for purpose in purposes for package in PURPOSES[purpose]})


def missing(packages: Iterable[str]) -> list[str]:
    """Those of some packages that are not installed; packages that another one provides count."""
    try:
        query = subprocess.run(
            ["dpkg-query", "--show", "--showformat=${db:Status-Status} ${Package} ${Provides}\n"],
            capture_output=True,
            text=True,
            check=True,
        )
    except (OSError, subprocess.CalledProcessError):
        raise IcwaferError(
            "dpkg-query does not work here; icwafer builds on Debian 12, use such a machine"
        ) from None
    present: set[str] = set()
    for line in query.stdout.splitlines():
        status, _, names = line.partition(" ")
        if status == "installed":
            package, _, provided = names.partition(" ")
            present.add(package)
            present.update(item.split()[0].split(":")[0] for item in provided.split(",") if item)
    return [package for package in packages if package not in present]


def install(*purposes: str) -> None:
    """Installs through apt what is missing for some purposes, and says what; else does nothing."""
    absent = missing(needed(*purposes))
    if not absent:
        return
    apt = ["apt-get", "-qy", "-o", "Acquire::Retries=3", "-o", "DPkg::Lock::Timeout=300"]
    by_hand = f"run as root: apt-get install {' '.join(absent)}"
    if os.geteuid() != 0:
        if not shutil.which("sudo"):
            raise IcwaferError(f"packages are missing and there is no sudo; {by_hand}")
        _log.info("Asking for root, to install %d Debian packages", len(absent))
        if subprocess.run(["sudo", "--validate"]).returncode != 0:
            raise IcwaferError(f"packages are missing and sudo refuses; {by_hand}")
        apt = ["sudo", "--non-interactive", "DEBIAN_FRONTEND=noninteractive", *apt]
    _log.info("Installing through apt: %s", " ".join(absent))
    environment = {"DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C"}
    try:
        progress.run(
            "Package lists", [*apt, "update"], paths.LOGS / "apt-update.log", environment
        )
    except IcwaferError as error:  # another repository may be at fault: the installation decides
        _log.warning("%s", error)
    progress.run(
        f"Installing {len(absent)} packages",
        [*apt, "install", "--no-install-recommends", *absent],
        paths.LOGS / "apt-install.log",
        environment,
        "check the network and apt's sources, then run the same command again",
    )
