# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  mesh_output.h)
set(ROOM_SOURCES
  mesh_output.cpp)
