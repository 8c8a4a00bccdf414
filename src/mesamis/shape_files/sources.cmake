# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  element_files.h
  file_kind.h
  mesh_files.h
  object_files.h
  surface_files.h
  surface_pair.h)
set(ROOM_SOURCES
  abaqus_elements.cpp
  abaqus_file.cpp
  amf_file.cpp
  element_files.cpp
  file_kind.cpp
  frame_note.cpp
  gmsh_elements.cpp
  gmsh_file.cpp
  medit_files.cpp
  mesh_checks.cpp
  mtl_file.cpp
  obj_file.cpp
  object_files.cpp
  NEXT febio_file.cpp
  ply_file.cpp
  pvtu_file.cpp
  stl_file.cpp
  threemf_file.cpp
  threemf_writer.cpp
  vtk_xml.cpp
  vtk_xml_writer.cpp
  vtp_file.cpp
  vtp_writer.cpp
  vtu_file.cpp
  NEXT surface_files.cpp
  vtk_file.cpp
  NEXT encapsulated_file.cpp
  NEXT glb_file.cpp
  NEXT surface_pair.cpp)
