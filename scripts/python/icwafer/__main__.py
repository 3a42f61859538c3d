# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes `python3 -m icwafer` the command."""

import sys

from icwafer.cli import main

sys.exit(main(sys.argv[1:]))
