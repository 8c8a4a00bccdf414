# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  components.h
  distance.h
  extract.h
  normals.h
  tri_mesh.h)
set(ROOM_SOURCES
  components.cpp
  distance.cpp
  edge_sides.cpp
  extract_band.cpp
  extract_solid.cpp
  normals.cpp
  sampling.cpp
  tri_mesh.cpp
  triangle_tree.cpp)
