# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  patient.h
  choose_object.h
  keep.h
  known_level.h
  mirror.h
  object_request.h
  padding.h
  places.h
  split_at_seeds.h
  tissue.h
  tissue_level.h
  voxel_distance.h
  voxel_islands.h
  whole_values.h)
set(ROOM_SOURCES
  patient.cpp
  choose_object.cpp
  keep.cpp
  mirror.cpp
  padding.cpp
  split_at_seeds.cpp
  tissue.cpp
  tissue_level.cpp
  voxel_islands.cpp
  whole_values.cpp
  NEXT places.cpp
  NEXT voxel_distance.cpp)
