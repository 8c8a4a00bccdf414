// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/progress.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/method/settings.h"
#include "mesamis/object/choose_object.h"

/// Runs on the image of a chosen object. Whatever they say in native units is in those of the scan,
/// also where the image is mirrored; for a range of values it is by how much a sample lies within.
namespace mesamis::detail::method {

/// Makes the request that belongs to the settings of a run: their crop, their level, and whether a
/// level is needed.
ObjectRequest object_request(const Settings& settings);

/// Makes the settings of mes_amis() for the image of a chosen object, in its units: no crop, which
/// has been done; the object's level; of one seed the largest island.
/// @param settings  as the user gave them, units of the scan.
ImageSettings settings_for(const ChosenObject& object, Settings settings);

/// Turns what a run on the image used back to the units and the voxels of the scan: the settings of
/// these parameters repeat the run.
Parameters in_scan_units(Parameters parameters, const ChosenObject& object);

/// Runs the method on the image of a chosen object.
/// @param object    of choose_object(), without parts.
/// @param settings  as the user gave them, units of the scan.
/// @param progress, enough  optional, as for mes_amis().
/// @return as mes_amis(), parameters in the units of the scan; u is what it is in the image.
/// @throws InputError, Cancelled  as mes_amis(). Cost as there.
Result run_on_object(const ChosenObject& object, const Settings& settings,
                     const Progress& progress = {}, const HasEnough& enough = {});

/// A chosen object where the samples of its image lie elsewhere, see choose_in_place(). It refers
/// to the object, which must live as long.
struct ObjectInPlace {
  const ChosenObject& object;
  VolumeView image;  ///< of the object's grid, native units; read in place
};

/// Runs the method on the image of an object in place.
/// @param object, settings, progress, enough  as for a chosen object.
/// @throws InputError, Cancelled  as mes_amis(). Cost as there.
Result run_on_object(const ObjectInPlace& object, const Settings& settings,
                     const Progress& progress = {}, const HasEnough& enough = {});

/// Finds the objects of a label map in the image of a chosen object.
/// @param object    of choose_object().
/// @param request   labels on a grid of their own, or the parts of the object that several seeds
/// split.
/// @param settings, progress  as for run_on_object().
/// @return as find_labelled_objects(), levels in the units of the scan.
/// @throws InputError, Cancelled  as find_labelled_objects(). Cost as there.
LabelResult run_on_labels(const ChosenObject& object, const LabelRequest& request,
                          const Settings& settings, const Progress& progress = {});

/// Finds the objects of a label map in the image of an object in place.
/// @param object, request, settings, progress  as for a chosen object.
/// @throws InputError, Cancelled  as find_labelled_objects(). Cost as there.
LabelResult run_on_labels(const ObjectInPlace& object, const LabelRequest& request,
                          const Settings& settings, const Progress& progress = {});

}  // namespace mesamis::detail::method
