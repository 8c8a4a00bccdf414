# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS remesh.h)
set(ROOM_SOURCES
  ball_shape.cpp
  cavity.cpp
  collapse.cpp
  edge_candidates.cpp
  explore.cpp
  metric_sampler.cpp
  partition.cpp
  remesh.cpp
  repair.cpp
  smooth.cpp
  split.cpp
  swap.cpp
  working_mesh.cpp)
