# SPDX-License-Identifier: GPL-2.0-or-later
#
# Blender and the cycles program with the node: the source, our edits, the configuration, the
# compilation, each only as far as something changed. `cmake --install` makes the folder that runs
# from anywhere on the machine.
#
# The host's folders stand at fixed places below build/, the same in every clone, so that a
# compiler cache serves them all.

option(ICWAFER_FULL
  "Blender with everything that Debian's package has, motion tracking and audio devices included"
  OFF
)
set(ICWAFER_BLENDER_SOURCE "" CACHE PATH
  "Source tree of the same Blender version, used (as a copy) instead of Debian's source package"
)

set(host_folder ${PROJECT_SOURCE_DIR}/plugin/blender-3.4)
file(STRINGS ${host_folder}/edits.toml host_version REGEX "^version *=")
string(REGEX REPLACE "^version *= *\"(.*)\"$" "\\1" host_version "${host_version}")
set(host_source ${PROJECT_SOURCE_DIR}/build/source/blender-${host_version})
set(host_binary ${PROJECT_SOURCE_DIR}/build/blender)
set(host_stage ${host_binary}/stage)

if(ICWAFER_FULL)
  set(host_options ${host_folder}/options-full.cmake)
else()
  set(host_options ${host_folder}/options.cmake)
endif()
find_program(ICWAFER_CCACHE ccache DOC "Compiler cache, used if there is one")
if(ICWAFER_CCACHE)
  set(with_ccache ON)
else()
  set(with_ccache OFF)
endif()

# The source with our edits: looked at in every build, and written only where something changed.
add_custom_target(host_source
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PROJECT_SOURCE_DIR}/scripts/python
    ${ICWAFER_PYTHON} -B -m icwafer source --from=${ICWAFER_BLENDER_SOURCE}
  USES_TERMINAL VERBATIM
)

# Configured again when an option changes; the host itself notices changes of its own lists.
set(configure_host
  ${CMAKE_COMMAND} -G Ninja -C ${host_options} -S ${host_source} -B ${host_binary}
  -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_INSTALL_PREFIX=${host_stage}
  -DCMAKE_PROJECT_Blender_INCLUDE=${host_folder}/compile_time.cmake
  -DWITH_COMPILER_CCACHE=${with_ccache}
)
list(JOIN configure_host "\n" configure_host_text)
file(CONFIGURE OUTPUT host_configuration.txt CONTENT "${configure_host_text}\n" @ONLY)
add_custom_command(
  OUTPUT ${host_binary}/build.ninja
  COMMAND ${configure_host}
  COMMAND ${CMAKE_COMMAND} -E touch ${host_binary}/build.ninja
  DEPENDS
    ${CMAKE_CURRENT_BINARY_DIR}/host_configuration.txt
    ${host_folder}/options.cmake
    ${host_folder}/compile_time.cmake
    ${host_options}
  USES_TERMINAL VERBATIM
)

if(ICWAFER_BUILD STREQUAL "blender")
  set(host_target install)
else()
  set(host_target cycles)
endif()
add_custom_target(host ALL
  COMMAND ${CMAKE_COMMAND} -E env --unset=DESTDIR --unset=NINJA_STATUS
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    ${CMAKE_COMMAND} --build ${host_binary} --target ${host_target}
  DEPENDS ${host_binary}/build.ninja
  USES_TERMINAL VERBATIM
)
add_dependencies(host host_source)

if(ICWAFER_BUILD STREQUAL "blender")
  # Debian's patches install Blender's scripts and translations as for /usr; beside the program it
  # looks for them in the folder of its version.
  string(REGEX REPLACE "\\.[0-9]+$" "" version_folder ${host_version})
  install(DIRECTORY ${host_stage}/ DESTINATION . USE_SOURCE_PERMISSIONS
    REGEX "/stage/share$" EXCLUDE
  )
  install(DIRECTORY ${host_stage}/share/blender/scripts DESTINATION ${version_folder}
    USE_SOURCE_PERMISSIONS OPTIONAL
  )
  install(DIRECTORY ${host_stage}/share/locale DESTINATION ${version_folder}/datafiles OPTIONAL)

  include(${CMAKE_CURRENT_LIST_DIR}/install_addon.cmake)
else()
  install(PROGRAMS ${host_binary}/bin/cycles DESTINATION .)
endif()
