# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  comparison_json.h
  json_file.h
  remesh_json.h
  report.h
  run_summary.h
  settings_json.h
  verdict.h)
set(ROOM_SOURCES
  comparison_json.cpp
  json_file.cpp
  remesh_json.cpp
  report.cpp
  run_summary.cpp
  settings_json.cpp
  verdict.cpp)
