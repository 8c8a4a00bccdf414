# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  label_output.h
  mesh_output.h)
set(ROOM_SOURCES
  label_output.cpp
  mesh_output.cpp)
