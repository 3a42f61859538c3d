# SPDX-License-Identifier: GPL-2.0-or-later
"""The measures by which two images are compared, and what a threshold on each one means."""

#: PSNR fails below its threshold, the others above.
MEASURES = {
    "mean": "mean absolute difference above X",
    "rms": "RMS difference above X",
    "psnr": "PSNR below X dB, for a peak of 1",
    "max": "largest difference of a channel above X",
    "yee": "more than the share X of the pixels of visibly other colour (Yee 2004), 0 to 1",
    "flip": "mean FLIP of the images as a screen shows them above X, 0 to 1",
    "hdr-flip": "mean HDR-FLIP of scene-linear images above X, 0 to 1",
}
