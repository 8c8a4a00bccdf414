// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/volume.h"
#include "mesamis/labels/label_block.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"
#include "mesamis/surface/partition.h"
#include "mesamis/surface/smooth_memberships.h"
#include "mesamis/surface/tri_mesh.h"

/// Surfaces of the objects of a label map: the labels choose the objects, the image places their
/// surfaces.
namespace mesamis::detail::method {

/// How labels are smoothed before a net is extracted that is smoothed itself: volumes need not match.
inline constexpr SmoothOptions kBeforeNet{.most_rounds = 1};

/// The boundaries between all labels of a layer, which have the steps of their voxels.
struct LayerPartition {
  PartitionSurface partition;     ///< the block's axes, its first voxel at 0, mm; sides are labels
  std::vector<double> volumes{};  ///< of the voxels of each label, mm^3
};

/// The boundaries between all labels of a map, which were extracted of their smooth_memberships()
/// beforehand, slab by slab.
struct ExtractedBoundaries {
  LabelBlock block;  ///< of the map's voxels: around the chosen segments; within the scan, if any
  /// Those of a layer.
  std::function<LayerPartition(Index layer)> of_layer;
};

/// Which objects are meant, and how exact their labels are.
struct LabelRequest {
  const LabelMap& map;             ///< valid; on a grid of its own, world coordinates decide
  std::vector<Segment> chosen{};   ///< of the map; empty: all of them
  std::optional<double> margin{};  ///< mm, > 0: how far the labels may be wrong;
                                   ///< at most 50 voxels; see label_margin()
  bool mesh = false;               ///< also make a mesh, see LabelResult
  /// Of which the map is most_probable(); it must live as long. Boundaries without an image are
  /// then where two objects are as probable, see probable_memberships(); none: see
  /// smooth_memberships().
  const Probabilities* probabilities = nullptr;
  /// Extracted boundaries, of which each chosen layer is asked for once; they must live as long. With
  /// a scan the map must lie on its grid, and starts_from_labels() must hold; without one the map
  /// needs no layers. nullptr: they are extracted.
  const ExtractedBoundaries* extracted = nullptr;
};

/// One object, world frame (LPS), mm.
struct LabelledObject {
  Segment segment;
  TriMesh surface;  ///< closed, 2-manifold, oriented outward
  /// At its points, mm; empty where the image placed none of its boundaries.
  std::vector<double> expected_error;
  std::int64_t triangles_extracted = 0;
};

/// The boundary between two objects, or of an object and the background.
struct LabelBoundary {
  std::string first, second;  ///< names; empty: the background
  double level = 0;           ///< half way between both sides, native units
  double contrast = 0;        ///< of the first above the second, native units
  bool followed = false;      ///< the image placed it; else the labels did
};

/// What a label map became. Objects of one layer share their boundaries: the same triangles,
/// without gaps and without overlap.
struct LabelResult {
  Parameters parameters;   ///< of the run; without an image those of the surface alone
  MeasuredImage image;     ///< without an image nothing
  bool has_image = false;  ///< the image placed the surfaces; else the labels alone
  double margin = 0;       ///< see LabelRequest
  double decimated = 0;    ///< greatest move of a boundary by rounding and decimation, mm
  std::vector<LabelledObject> objects;    ///< by layer, in the order chosen
  std::vector<LabelBoundary> boundaries;  ///< of the chosen objects; none without an image
  /// Around the chosen labels, adapted to the image and to all labels; see mesh_beside_labels().
  std::optional<Result> mesh;
  struct Seconds {
    double prepare = 0, flow = 0, surface = 0, printable = 0, mesh = 0, total = 0;
  } seconds;
  bool flow_converged = true;  ///< every system of the labels' flow was solved to its tolerance
};

/// How far labels may be wrong, if the user does not say: two and a half of their own voxels (the
/// geometric mean of the spacing), but at least as many of the scan's.
/// @return mm.
double label_margin(const VoxelGrid& scan, const VoxelGrid& labels);

/// The margin of a run.
/// @param asked  mm; none: label_margin().
/// @throws InputError  unless it is more than 0 and at most 50 voxels of the scan.
double margin_of(const std::optional<double>& asked, const VoxelGrid& scan,
                 const VoxelGrid& labels);

/// Voxels of the scan: boundaries of labels no coarser start from the labels.
inline constexpr double kCoarsestFitted = 1.25;

/// Whether boundaries beside a scan start from those of the labels alone, which are no coarser than
/// kCoarsestFitted. Coarser labels flow to the edges of the image first; without Settings::fit all
/// do.
bool starts_from_labels(const Settings& settings, const VoxelGrid& scan, const VoxelGrid& labels);

/// Finds the objects of a label map in a scan.
///
/// Boundaries start from the labels, see starts_from_labels(), or from where these flow to: to the
/// nearest edges v of algorithm 1 within the margin (flow_memberships()). Each is then fitted to the
/// image (fit_boundaries()), or without Settings::fit follows it to its own half maximum
/// (follow_image()); decimation keeps what objects share. The mesh is made last, with no preview.
/// Labels that were not chosen take part: an object ends where they begin.
///
/// @param scan      native units.
/// @param request   see there.
/// @param settings  those of the image, the functional and the surface's decimation.
/// @param progress  optional.
/// @return one object per chosen segment that has voxels within the scan and keeps some of them.
/// @throws InputError  if no chosen label lies within the scan, more than 4096 are chosen, or the
///                     scan cannot be used.
/// @throws Cancelled   if progress says stop.
///
/// O(voxels of the scan * layers) to bring the labels onto its grid; then O(voxels around the
/// labels) per layer, about 100 bytes for each. The same bits for any number of threads.
LabelResult find_labelled_objects(const VolumeView& scan, const LabelRequest& request,
                                  const ImageSettings& settings, const Progress& progress = {});

/// Makes smooth surfaces of a label map alone, see smooth_memberships().
/// @return one object per chosen segment that has voxels.
/// @throws InputError  if no chosen label has a voxel, or more than 4096 are chosen.
/// @throws Cancelled   if progress says stop.
///
/// O(voxels around the labels); about 40 bytes for each. The same bits for any number of threads.
LabelResult surfaces_of_labels(const LabelRequest& request, const Settings& settings,
                               const Progress& progress = {});

/// The layers of segments, increasing.
std::vector<Index> layers_of(const std::vector<Segment>& segments);

/// Whether a label of a layer was chosen: one entry per label, not 0 if it was.
std::vector<char> marks_of(const std::vector<Segment>& chosen, Index layer);

/// @throws InputError  if more than 4096 segments are chosen, one twice, or one that is none of the
///                     map's.
void require_chosen(const std::vector<Segment>& chosen, const LabelMap& map);

/// Objects that share boundaries are solids: checks it wherever the settings come from.
/// @throws InputError  if the settings ask for a band.  O(1).
void require_solids(const Settings& settings);

/// @throws InputError  that no chosen segment has a voxel.
[[noreturn]] void refuse_empty(const std::vector<Segment>& chosen);

}  // namespace mesamis::detail::method
