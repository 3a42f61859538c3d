# SPDX-License-Identifier: GPL-2.0-or-later
#
# What of the project runs inside the installed Blender: the add-on, the part of the Python package
# that it needs, the sources of the asset library and, where it is built, the library. The component
# `addon` is all this and nothing else: `cmake --install build/host --component addon`.

set(addon ${version_folder}/scripts/addons/ic_wafer)
set(modules ${version_folder}/scripts/modules/icwafer)
set(library ${version_folder}/datafiles/icwafer)
set(package ${PROJECT_SOURCE_DIR}/scripts/python/icwafer)

# These three folders are the project's own. What an earlier version has left there would still be
# imported by a script, or shown in the asset browser.
install(
  CODE "set(own_folders ${addon} ${modules} ${library})"
  CODE [[
    list(TRANSFORM own_folders PREPEND "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/")
    file(REMOVE_RECURSE ${own_folders})
  ]]
  COMPONENT addon
)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/plugin/addon/ DESTINATION ${addon} COMPONENT addon
  PATTERN __pycache__ EXCLUDE
)

# No commands, no build, no plots.
install(
  FILES
    ${package}/__init__.py
    ${package}/attributes.py
    ${package}/errors.py
    ${package}/files.py
    ${package}/suggest.py
    ${package}/toml_lines.py
  DESTINATION ${modules} COMPONENT addon
)
install(
  DIRECTORY
    ${package}/chips
    ${package}/layout_import
    ${package}/pictures
    ${package}/portrait
    ${package}/scene
  DESTINATION ${modules} COMPONENT addon
  PATTERN __pycache__ EXCLUDE
  PATTERN command.py EXCLUDE
  PATTERN kept.py EXCLUDE
  PATTERN library EXCLUDE
  PATTERN map_picture.py EXCLUDE
  PATTERN plot.py EXCLUDE
  REGEX "/portrait/render[.]py$" EXCLUDE
)
install(FILES ${package}/assets/__init__.py ${package}/assets/materials.py
  DESTINATION ${modules}/assets COMPONENT addon
)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/blend_assets/library/ DESTINATION ${library}
  COMPONENT addon
)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/assets/ DESTINATION ${library}
  COMPONENT addon OPTIONAL
  FILES_MATCHING PATTERN "*.blend"
)
