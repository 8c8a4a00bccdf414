# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  baseline_surface.h
  geodesic_contour.h
  isosurface.h)
set(ROOM_SOURCES
  baseline_surface.cpp
  geodesic_contour.cpp
  isosurface.cpp
  NEXT itk_absent.cpp
  NEXT itk_level_set.cpp
  NEXT vtk_absent.cpp
  NEXT vtk_isosurface.cpp)
