# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  experiment.h
  part_inside.h
  study_diagrams.h
  study_json.h
  study_run.h
  study_tables.h)
set(ROOM_SOURCES
  experiment.cpp
  part_inside.cpp
  study_diagrams.cpp
  study_json.cpp
  study_run.cpp
  study_tables.cpp)
