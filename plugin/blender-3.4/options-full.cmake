# SPDX-License-Identifier: GPL-2.0-or-later
#
# Everything that Debian's own package of Blender 3.4.1 has. Read by `cmake -C`.

include(${CMAKE_CURRENT_LIST_DIR}/options.cmake)

set(full
  WITH_CODEC_SNDFILE
  WITH_CYCLES_DEVICE_CUDA
  WITH_CYCLES_DEVICE_HIP
  WITH_INPUT_NDOF
  WITH_JACK
  WITH_LIBMV
  WITH_MOD_FLUID
  WITH_OPENAL
  WITH_OPENCOLLADA
  WITH_SDL
)
foreach(option IN LISTS full)
  set(${option} ON CACHE BOOL "" FORCE)
endforeach()
