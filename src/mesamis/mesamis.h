// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/error.h"
#include "mesamis/base/progress.h"
#include "mesamis/base/threads.h"
#include "mesamis/base/types.h"
#include "mesamis/base/version.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/settings.h"
#include "mesamis/object/object_request.h"
#include "mesamis/picture/picture.h"
#include "mesamis/report/body_wishes.h"
#include "mesamis/run/outcome.h"
#include "mesamis/run/segment.h"
#include "mesamis/run/write.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/tri_mesh.h"
#include "mesamis/volume_files/read_volume.h"

/// From a 3D scan to a closed surface that can be printed, an adapted mesh that carries the grey
/// values, and a body for a solver.
///
///   mesamis::Request request;
///   request.scan = mesamis::read_volume("head.nii.gz").volume;  // or a VolumeView on your samples
///   const mesamis::Outcome outcome = mesamis::segment(std::move(request));
///   mesamis::write(outcome, {.surfaces = {"skull.stl"}, .report = "skull.json"});
///
/// segment() is what the program `mesamis segment` does, and write() writes the same bytes. Every
/// result has the same bits for any number of threads. Coordinates are in the world frame (LPS),
/// mm. A function that cannot use what it is given throws InputError, whose message is one line:
/// what was expected, what was found.
///
/// The headers that this one includes are the library; no other is installed.
namespace mesamis {}
