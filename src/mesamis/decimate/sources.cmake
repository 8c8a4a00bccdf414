# SPDX-License-Identifier: Apache-2.0
# The only room that includes OpenMesh.
set(ROOM_HEADERS
  cover.h
  crease.h
  decimate.h
  decimate_part.h
  decimate_partition.h
  interface_trees.h
  normal_moves.h
  patch.h
  refit.h
  round_to_single.h
  round_together.h
  single_places.h)
set(ROOM_SOURCES
  collapse_rules.cpp
  decimate.cpp
  decimate_partition.cpp
  decimate_patch.cpp
  fan_distance.cpp
  patch.cpp
  patchwork.cpp
  round_together.cpp
  interfaces.cpp
  NEXT decimation.cpp
  interface_trees.cpp
  normal_moves.cpp
  refit.cpp
  round_to_single.cpp
  NEXT decimate_pass.cpp)
