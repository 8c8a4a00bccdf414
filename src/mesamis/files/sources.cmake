# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  atomic_file.h
  dicom_subject.h
  output_set.h
  read_limits.h
  read_record.h
  sha256.h
  utf8.h
  xml_text.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  byte_source.h
  bytes.h
  deflate.h
  dicom_data.h
  dicom_text.h
  dicom_writer.h
  file_list.h
  given_spacing.h
  in_one_line.h
  json_value.h
  length_unit.h
  memory_budget.h
  number_type.h
  owned_file.h
  refuse.h
  text_scan.h
  text_writer.h
  value_axes.h
  xml.h
  zip_archive.h)
set(ROOM_SOURCES
  atomic_file.cpp
  byte_source.cpp
  deflate.cpp
  file_list.cpp
  given_spacing.cpp
  json_value.cpp
  length_unit.cpp
  memory_budget.cpp
  output_set.cpp
  owned_file.cpp
  pending_file.cpp
  refuse.cpp
  sha256.cpp
  utf8.cpp
  value_axes.cpp
  xml_text.cpp
  zip_archive.cpp
  NEXT read_record.cpp
  xml.cpp
  NEXT dicom_data.cpp
  NEXT dicom_subject.cpp
  dicom_text.cpp
  dicom_writer.cpp)
