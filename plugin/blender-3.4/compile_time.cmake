# SPDX-License-Identifier: GPL-2.0-or-later
#
# What shortens the compilation of Blender 3.4.1 without a change of its sources or of what it
# renders. Read by Blender's own project(), as CMAKE_PROJECT_Blender_INCLUDE.

# Blender's warnings are for those who change it, and looking for them takes time.
add_compile_options(-w)

# Several sources of a library compiled as one: most of a C++ file's time goes into headers that its
# neighbours need too. Blender does so itself for its nodes; these are further libraries in which
# it saves most.
set(ICWAFER_UNITY_TARGETS
  audaspace
  bf_blenkernel
  bf_blenlib
  bf_compositor
  bf_depsgraph
  bf_draw
  bf_editor_sculpt_paint
  bf_editor_space_node
  bf_editor_space_outliner
  bf_editor_space_spreadsheet
  bf_freestyle
  bf_functions
  bf_geometry
  bf_gpu
  bf_intern_cycles
  bf_realtime_compositor
  bf_wavefront_obj
  cycles_bvh
  cycles_device
  cycles_graph
  cycles_integrator
  cycles_scene
  cycles_subd
  extern_bullet
)

# Sources that do not get along with others: they repeat each other's names, need a macro before the
# first header, or leave one behind. And those that include headers of ours, so that a change of one
# compiles little else. Some are known by a common part of their names.
set(ICWAFER_UNITY_EXCEPT
  FFMPEG.cpp
  JackLibrary.cpp
  PluginManager.cpp
  PulseAudioLibrary.cpp
  asset_catalog.cc
  asset_library.cc
  attribute_access.cc
  curve.cc
  customdata.cc
  draw_hair.cc
  draw_pointcloud.cc
  draw_volume.cc
  gpu_matrix.cc
  ic_wafer_node.cpp
  icons.cc
  image.cc
  image.cpp
  image_vdb.cpp
  lib_override.cc
  link_drag_search.cc
  main_namemap.cc
  mball.cc
  mball_tessellate.cc
  mesh.cc
  mesh_convert.cc
  mesh_legacy_convert.cc
  mesh_remesh_voxel.cc
  mesh_validate.cc
  modifier.cc
  multires.cc
  node.cc
  object.cc
  object.cpp
  rand.cc
  scene.cc
  shader.cpp
  volume.cc
  volume.cpp
  volume_render.cc
  volume_to_mesh.cc
)
string(CONCAT ICWAFER_UNITY_EXCEPT_PATTERN
  "\\.c$|/python/.*\\.cpp$|/AUD_[A-Za-z]*\\.cpp$|/deg_eval_runtime_backup|/geometry_component_"
  "|engines/(compositor|image|eevee|eevee_next)/|(^|/)(cuda|hip)/"
)

function(icwafer_use_unity)
  foreach(target IN LISTS ICWAFER_UNITY_TARGETS)
    if(NOT TARGET ${target})
      continue()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    get_target_property(sources ${target} SOURCES)
    get_target_property(folder ${target} SOURCE_DIR)
    foreach(source IN LISTS sources)
      cmake_path(GET source FILENAME name)
      if(name IN_LIST ICWAFER_UNITY_EXCEPT OR source MATCHES "${ICWAFER_UNITY_EXCEPT_PATTERN}")
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
        set_source_files_properties(${source} TARGET_DIRECTORY ${target}
          PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
        )
      endif()
    endforeach()
  endforeach()
endfunction()

# Less optimisation for the interface, which waits for people, and for sources that are little more
# than OpenVDB's templates, of which the compiler makes more than of all else.
set(ICWAFER_LIGHT_TARGETS
  "^(bf_blenloader|bf_depsgraph|bf_editor_.*|bf_freestyle|bf_nodes|bf_nodes_shader|bf_python.*|bf_rna)$"
)
set(ICWAFER_LIGHT_SOURCES
  intern/cycles/scene:volume.cpp:cycles_scene
  source/blender/blenkernel:intern/volume.cc:bf_blenkernel
  source/blender/blenkernel:intern/volume_to_mesh.cc:bf_blenkernel
  source/blender/geometry:intern/mesh_to_volume.cc:bf_geometry
  source/blender/modifiers:intern/MOD_volume_displace.cc:bf_modifiers
)

function(icwafer_lighten folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  list(FILTER targets INCLUDE REGEX "${ICWAFER_LIGHT_TARGETS}")
  foreach(target IN LISTS targets)
    target_compile_options(${target} PRIVATE -O1)
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(child IN LISTS folders)
    icwafer_lighten(${child})
  endforeach()
endfunction()

function(icwafer_shorten)
  icwafer_use_unity()
  icwafer_lighten(${CMAKE_SOURCE_DIR})
  foreach(entry IN LISTS ICWAFER_LIGHT_SOURCES)
    string(REPLACE ":" ";" entry ${entry})
    list(POP_FRONT entry folder source target)
    set_source_files_properties(${CMAKE_SOURCE_DIR}/${folder}/${source}
      TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS -O1
    )
  endforeach()
endfunction()

# Once all targets are there.
cmake_language(DEFER CALL icwafer_shorten)
