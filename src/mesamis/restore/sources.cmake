# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  deblur.h
  half_maximum_level.h
  impulses.h
  level_crossings.h
  local_level.h
  object_contrast.h
  object_edge.h
  restore.h
  scan_quality.h
  surface_extent.h
  tissue_threshold.h)
set(ROOM_SOURCES
  deblur.cpp
  edge_level.cpp
  edge_profile.cpp
  half_maximum_level.cpp
  impulses.cpp
  level_crossings.cpp
  nearby_range.cpp
  object_contrast.cpp
  scan_quality.cpp
  surface_extent.cpp
  thick_places.cpp
  tissue_threshold.cpp
  NEXT object_edge.cpp
  local_level.cpp
  thin_sheets.cpp
  NEXT restore.cpp
  value_variation.cpp)
