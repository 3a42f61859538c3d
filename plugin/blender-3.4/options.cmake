# SPDX-License-Identifier: GPL-2.0-or-later
#
# What Blender 3.4.1 is built with, on Debian 12: all that an artist who renders needs. Blender's
# own defaults stand where nothing is said here. Read by `cmake -C`.

set(on
  WITH_CODEC_FFMPEG
  WITH_CYCLES_STANDALONE
  WITH_FFTW3
  WITH_IMAGE_OPENJPEG
  WITH_INSTALL_PORTABLE
  WITH_MOD_OCEANSIM
)

# Without rendering to do with it, and slow to build: options-full.cmake switches them on.
set(full_only
  WITH_CODEC_SNDFILE
  WITH_CYCLES_DEVICE_CUDA
  WITH_CYCLES_DEVICE_HIP
  WITH_IK_ITASC
  WITH_INPUT_NDOF
  WITH_JACK
  WITH_LIBMV
  WITH_MOD_FLUID
  WITH_OPENAL
  WITH_OPENCOLLADA
  WITH_PULSEAUDIO
  WITH_QUADRIFLOW
  WITH_SDL
)
set(off ${full_only})

# Debian 12 lacks the library, has one that Blender 3.4.1 does not build with, or does without it in
# its own package.
list(APPEND off
  WITH_ALEMBIC
  WITH_CYCLES_DEVICE_OPTIX
  WITH_CYCLES_OSL
  WITH_CYCLES_PATH_GUIDING
  WITH_GHOST_WAYLAND
  WITH_LLVM
  WITH_NANOVDB
  WITH_OPENIMAGEDENOISE
  WITH_USD
  WITH_XR_OPENXR
)

# The same sources give the same program; the system's Python is used in place; an optional library
# that is missing is left out.
list(APPEND off
  WITH_BUILDINFO
  WITH_PYTHON_INSTALL
  WITH_STRICT_BUILD_OPTIONS
)

foreach(option IN LISTS on)
  set(${option} ON CACHE BOOL "" FORCE)
endforeach()
foreach(option IN LISTS off)
  set(${option} OFF CACHE BOOL "" FORCE)
endforeach()

set(PYTHON_VERSION 3.11 CACHE STRING "" FORCE)
set(FREETYPE_INCLUDE_DIRS /usr/include/freetype2 CACHE PATH "" FORCE)
