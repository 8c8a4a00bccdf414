# SPDX-License-Identifier: Apache-2.0
# The only room that includes OpenMesh.
set(ROOM_HEADERS
  decimate.h
  decimate_partition.h
  round_to_single.h
  round_together.h)
set(ROOM_SOURCES
  collapse_rules.cpp
  cover.cpp
  decimate.cpp
  decimate_partition.cpp
  decimate_pass.cpp
  decimate_patch.cpp
  decimation.cpp
  fan_distance.cpp
  patchwork.cpp
  round_to_single.cpp
  round_together.cpp
  sheets.cpp)
