# SPDX-License-Identifier: GPL-2.0-or-later
"""From scene-linear colours to a screen and to Rec.709, through OpenColorIO."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import PyOpenColorIO as ocio

from icwafer import paths
from icwafer.compare import srgb
from icwafer.errors import InputError
from icwafer.suggest import unknown

#: Configurations to look for: the built Blender's, then that of Debian's package.
CONFIGURATIONS = (
    paths.INSTALLED / paths.host_version().rpartition(".")[0]
    / "datafiles" / "colormanagement" / "config.ocio",
    Path("/usr/share/blender/datafiles/colormanagement/config.ocio"),
)  # fmt: skip

# ACES2065-1 to linear Rec.709: ACES' published colour space conversion (Bradford, D60 to D65).
_AP0_TO_REC709 = np.array(
    [
        [2.5216494, -1.1368885, -0.3849175],
        [-0.2752136, 1.3697052, -0.0943925],
        [-0.0159251, -0.1478064, 1.1638058],
    ]
)


@dataclass(frozen=True)
class ViewTransform:
    """How scene-linear colours get to a screen: names of the OpenColorIO configuration's.

    `config` is None for the sRGB curve alone, of a machine without a configuration.
    """

    config: ocio.Config | None
    source: str
    display: str
    view: str
    look: str

    @property
    def name(self) -> str:
        """View, look and display."""
        look = f", {self.look}" if self.look else ""
        return f"{self.view}{look} on {self.display}"

    def __str__(self) -> str:
        return f"{self.name} ({self.source})"

    def encode(self, linear: np.ndarray) -> np.ndarray:
        """Scene-linear to encoded values for the screen, 0 to 1; any leading shape x 3."""
        if self.config is None:
            return np.clip(srgb.encode(np.clip(linear, 0.0, 1.0)), 0.0, 1.0)
        transform = ocio.LegacyViewingPipeline()
        transform.setDisplayViewTransform(
            ocio.DisplayViewTransform(
                src=ocio.ROLE_SCENE_LINEAR, display=self.display, view=self.view
            )
        )
        if self.look:
            transform.setLooksOverrideEnabled(True)
            transform.setLooksOverride(self.look)
        return np.clip(_apply(transform.getProcessor(self.config), linear), 0.0, 1.0)

    def to_rec709(self, linear: np.ndarray) -> np.ndarray:
        """Scene-linear to linear Rec.709, through the same roles in the same order as Cycles.

        A configuration without them counts as Rec.709, as it does for Cycles.
        """
        if self.config is None:
            return linear
        for role, matrix in (("aces_interchange", _AP0_TO_REC709), ("XYZ", srgb.XYZ_TO_REC709)):
            if self.config.hasRole(role):
                processor = self.config.getProcessor(ocio.ROLE_SCENE_LINEAR, role)
                return _apply(processor, linear) @ matrix.T
        return linear


#: Of images that hold what a screen shows.
SRGB_CURVE = ViewTransform(None, "no OpenColorIO configuration", "sRGB", "sRGB curve", "")


def view_transform(
    config: Path | None = None,
    view: str | None = None,
    look: str | None = None,
    display: str | None = None,
) -> ViewTransform:
    """The view transform of that name; what is None is the configuration's default.

    config: a file; None: the variable OCIO, else the first of `CONFIGURATIONS`, else the sRGB
    curve. A look may leave out the view's name before " - ", as in Blender.

    Raises InputError for a configuration that cannot be read and for unknown names.
    """
    path = config or _default_configuration()
    if path is None:
        if view not in (None, "Standard") or look not in (None, "None"):
            raise InputError(
                f"no OpenColorIO configuration for view '{view}'; give one with --ocio"
            )
        return SRGB_CURVE
    try:
        loaded = ocio.Config.CreateFromFile(str(path))
    except ocio.Exception as error:
        reason = " ".join(str(error).split())
        raise InputError(f"{path}: not an OpenColorIO configuration ({reason})") from None
    display = _known("display", display, loaded.getDefaultDisplay(), list(loaded.getDisplays()))
    views = list(loaded.getViews(display))
    view = _known("view", view, loaded.getDefaultView(display), views)
    looks = list(loaded.getLookNames())
    if look in (None, "", "None"):
        look = ""
    else:
        prefixed = f"{view} - {look}"
        look = _known("look", prefixed if prefixed in looks else look, "", looks)
    return ViewTransform(loaded, str(path), display, view, look)


def _default_configuration() -> Path | None:
    if os.environ.get("OCIO"):
        return Path(os.environ["OCIO"])
    return next((path for path in CONFIGURATIONS if path.is_file()), None)


def _known(kind: str, name: str | None, default: str, names: list[str]) -> str:
    if name is None:
        return default
    if name not in names:
        raise InputError(unknown(kind, name, names))
    return name


def _apply(processor: ocio.Processor, colours: np.ndarray) -> np.ndarray:
    result = np.array(colours, dtype=np.float32, order="C")
    processor.getDefaultCPUProcessor().applyRGB(result)
    return result
