# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  plan.h
  run_in_slabs.h
  slab_work.h
  team.h)
set(ROOM_SOURCES
  archive.cpp
  background.cpp
  mapped_floats.cpp
  mesh_tasks.cpp
  piece.cpp
  plan.cpp
  records.cpp
  run_in_slabs.cpp
  sample.cpp
  scratch.cpp
  slab_tasks.cpp)
