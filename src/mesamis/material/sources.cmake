# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  element_moduli.h
  material_bins.h
  material_law.h
  materials.h
  rim.h)
set(ROOM_SOURCES
  density.cpp
  element_moduli.cpp
  material_bins.cpp
  material_law.cpp
  materials.cpp
  rim.cpp)
