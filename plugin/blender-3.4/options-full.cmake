# SPDX-License-Identifier: GPL-2.0-or-later
#
# Everything that Debian's own package of Blender 3.4.1 has. Read by `cmake -C`.

include(${CMAKE_CURRENT_LIST_DIR}/options.cmake)

foreach(option IN LISTS full_only)
  set(${option} ON CACHE BOOL "" FORCE)
endforeach()
