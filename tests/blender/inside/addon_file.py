# SPDX-License-Identifier: GPL-2.0-or-later
"""Report the active object of a file that the add-on has made something in.

Parameters: `blend`, the file.
"""

from __future__ import annotations

import bpy
from exchange import parameters, report
from thing_facts import thing_facts

bpy.ops.wm.open_mainfile(filepath=parameters()["blend"])
report(thing_facts(bpy.context.view_layer.objects.active))
