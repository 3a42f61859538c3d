# SPDX-License-Identifier: GPL-2.0-or-later
"""Real chips: from a layout file (GDSII, OASIS, DEF) to the blocks and groups of a die.

The steps, a module each: `worker` reads the file in a process of its own and cuts out the metal of
each tile (`reader` is our end of the pipe); `spectrum` finds the gratings in the outlines of a
tile; `optics` makes of all layers' gratings what an eye above the chip sees; `groups` merges equal
tiles; `importer` puts it all together. `process` knows the layers of a process.
"""
