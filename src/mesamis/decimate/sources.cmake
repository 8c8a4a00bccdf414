# SPDX-License-Identifier: Apache-2.0
# The only room that includes OpenMesh: rounding flips and collapses on it.
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
  simplify.h
  simplify_objects.h
  single_places.h)
set(ROOM_SOURCES
  collapse.cpp
  covering.cpp
  curves.cpp
  decimate.cpp
  decimate_partition.cpp
  patch.cpp
  patchwork.cpp
  quadric.cpp
  two_sided_bound.cpp
  rim_walk.cpp
  round_together.cpp
  editable_surface.cpp
  fan_height.cpp
  flip.cpp
  interfaces.cpp
  collapse_intersections.cpp
  NEXT decimation.cpp
  interface_trees.cpp
  normal_moves.cpp
  refit.cpp
  round_to_single.cpp
  simplify.cpp
  simplify_objects.cpp
  NEXT decimate_pass.cpp)
