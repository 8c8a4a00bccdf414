# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  edges.h
  gradation.h
  kuhn.h
  locate.h
  metric.h
  metric_field.h
  predicates.h
  tet_mesh.h)
set(ROOM_SOURCES
  edges.cpp
  gradation.cpp
  locate.cpp
  metric.cpp
  metric_field.cpp
  tet_mesh.cpp)
