# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  page_files.h
  run_page.h)
set(ROOM_SOURCES
  base64.cpp
  charts.cpp
  cross_section.cpp
  figures.cpp
  html.cpp
  mesh_cut.cpp
  page_files.cpp
  public_report.cpp
  run_page.cpp
  run_pictures.cpp
  scan_copy.cpp
  sections.cpp
  shown_run.cpp
  slice_view.cpp
  surface_copy.cpp
  surface_view.cpp
  NEXT page_assets.cpp)
