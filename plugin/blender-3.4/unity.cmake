# SPDX-License-Identifier: GPL-2.0-or-later
#
# Compiles several sources of a library as one: most of a C++ file's time goes into headers that
# its neighbours need too. Blender does so itself for its nodes; these are further libraries in
# which it saves most. Read by Blender's own project(), as CMAKE_PROJECT_Blender_INCLUDE.

set(ICWAFER_UNITY_TARGETS
  bf_compositor
  bf_depsgraph
  bf_freestyle
  bf_intern_cycles
  bf_realtime_compositor
  cycles_bvh
  cycles_device
  cycles_integrator
  cycles_scene
  cycles_subd
)

# Sources that do not get along with others: OpenVDB's headers clash with a macro of Cycles,
# Freestyle's Python bindings repeat each other's names, and a comparison is declared too late.
# And those that include headers of ours, so that a change of one compiles little else.
set(ICWAFER_UNITY_EXCEPT
  "/python/.*\\.cpp$"
  "(^|/)(image|image_vdb|object|volume)\\.cpp$"
  "/deg_eval_runtime_backup.*\\.cc$"
  "(^|/)(ic_wafer_node|shader)\\.cpp$"
)

function(icwafer_use_unity)
  foreach(target IN LISTS ICWAFER_UNITY_TARGETS)
    if(NOT TARGET ${target})
      continue()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    get_target_property(sources ${target} SOURCES)
    get_target_property(folder ${target} SOURCE_DIR)
    list(JOIN ICWAFER_UNITY_EXCEPT "|" except)
    list(FILTER sources INCLUDE REGEX "${except}")
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
      set_source_files_properties(${source} TARGET_DIRECTORY ${target}
        PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
      )
    endforeach()
  endforeach()
endfunction()
# Once all targets are there.
cmake_language(DEFER CALL icwafer_use_unity)
