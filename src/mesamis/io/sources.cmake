# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  atomic_file.h
  gcode.h
  geodesic_contour.h
  isosurface.h
  mesh_files.h
  picture.h
  plot.h
  read_volume.h
  surface_files.h
  write_volume.h)
set(ROOM_SOURCES
  # Volumes in: own readers over zlib, libtiff, and GDCM for compressed DICOM pixels.
  detail/byte_source.cpp
  detail/dicom_data.cpp
  detail/dicom_pixels.cpp
  detail/dicom_series.cpp
  detail/dicom_slice.cpp
  detail/files.cpp
  detail/inv3_file.cpp
  detail/meta_file.cpp
  detail/nifti_file.cpp
  detail/nrrd_file.cpp
  read_volume.cpp
  detail/refuse.cpp
  detail/scan_file.cpp
  sha256.cpp
  detail/text_header.cpp
  detail/tiff_file.cpp
  # Volumes out.
  write_volume.cpp
  # Surfaces and meshes in and out, files that appear whole.
  atomic_file.cpp
  isosurface.cpp
  detail/abaqus_file.cpp
  detail/amf_file.cpp
  detail/frame_note.cpp
  detail/gmsh_file.cpp
  detail/mesh_checks.cpp
  detail/obj_file.cpp
  detail/ply_file.cpp
  detail/stl_file.cpp
  detail/threemf_file.cpp
  detail/vtk_file.cpp
  detail/vtk_xml.cpp
  detail/vtp_file.cpp
  detail/vtu_file.cpp
  detail/xml.cpp
  medit_files.cpp
  mesh_files.cpp
  surface_files.cpp
  # A contour to compare with, by ITK; one of the two beside it is compiled.
  geodesic_contour.cpp
  detail/itk_absent.cpp
  detail/itk_level_set.cpp
  # What slicers write.
  gcode.cpp
  # Pictures.
  detail/annotation.cpp
  detail/color_scale.cpp
  detail/display.cpp
  picture.cpp
  plot.cpp
  detail/scene.cpp
  detail/slice.cpp
  detail/vtk_data.cpp
  detail/vtk_messages.cpp)
