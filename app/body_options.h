// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "mesamis/base/frame.h"
#include "mesamis/delivery/body_output.h"
#include "mesamis/delivery/body_request.h"
#include "mesamis/delivery/meshing_surface.h"
#include "mesamis/method/settings.h"
#include "progress.h"

namespace CLI {
class App;
}  // namespace CLI

/// The options of bodies for finite elements, and of surfaces for other meshers, which are their
/// skins.
namespace mesamis {

struct BodyArguments {
  std::vector<std::filesystem::path> files;  ///< --body
  std::string element = "tet4";              ///< --element
  std::string gmsh = "2.2";                  ///< --gmsh-version
  BodyOptions options;                     ///< --element-size, --element-gradation, --wall-elements
  std::optional<double> skin_tolerance;    ///< --skin-tolerance, mm
  std::string material, calibration, ash;  ///< as they were written; may be empty
  std::optional<double> gap, poisson;      ///< --material-gap, MPa; --poisson
  std::optional<double> rim;      ///< --material-rim, mm; none: as deep as the scan is blurred
  std::vector<std::string> sets;  ///< --set
  std::string surface_quality = "printing";  ///< --surface-quality
  /// The options given that mean nothing without elements, without --body, without --material.
  std::vector<std::string> of_elements, of_body, of_material;

  bool given() const { return !files.empty(); }
  bool meshing() const { return surface_quality == "meshing"; }
  bool elements() const { return given() || meshing(); }
};

/// Adds the options. `arguments` must outlive the parsing.
void add_body_options(CLI::App& command, BodyArguments& arguments);

/// Checks files, texts and what belongs together before any work.
/// @throws CLI::ValidationError, InputError  as require_output() and the parsers.
void require_body(const BodyArguments& arguments);

/// Checks settings that elements depend on before any work.
/// @throws CLI::ValidationError  for a band, and where neither setting nor --skin-tolerance is a
///                               tolerance for a skin.
void require_elements_for(const BodyArguments& arguments, const Settings& settings);

/// What the arguments ask for.
/// @param frame  that places and directions of sets are written in.
/// @throws CLI::ValidationError  as the parsers.
BodyWishes body_wishes(const BodyArguments& arguments, Frame frame);

/// What a run hands on to those who deliver its results.
struct RunContext {
  const Settings& settings;  ///< as they were asked for
  const CommonOptions& common;
  ProgressDisplay& display;
};

/// The objects whose elements are wanted, and where they lie.
struct ElementSource {
  const std::vector<FoundObject>& objects;
  const VoxelGrid& grid;         ///< that they were found on
  const Volume& scan;            ///< on the same grid; read for --body only
  Frame frame = Frame::kLps;     ///< that sets are written in
  std::array<double, 3> blur{};  ///< of the scan, standard deviation along each axis, voxels
};

/// What the elements of objects are asked for.
struct ElementResults {
  std::optional<BodyOutput> body;       ///< of --body
  std::string unmet;                    ///< what the body misses, see unmet(); empty: nothing
  std::vector<TriMesh> surfaces;        ///< of --surface-quality meshing, one per object
  std::vector<MeshingQuality> quality;  ///< of these surfaces; logged where a promise was missed
};

/// Fills objects with elements once, for all that is asked for; nothing if nothing is.
/// @throws InputError  as complete_request(), fill_objects() and make_body_output().
/// @throws Cancelled   if progress says stop.
ElementResults make_elements(const BodyArguments& arguments, const ElementSource& source,
                             const RunContext& run);

/// Puts the surface of elements in the place of the one that they were made for.
/// @param errors  that are expected at the points of the surface, mm; carried over. May be empty.
void take_surface(TriMesh&& of_elements, TriMesh& surface, std::vector<double>& errors);

/// What becomes of the status of a run whose body missed a promise: it is told, and the run ends
/// as one that did not keep it, unless it ends worse.
int status_with(const ElementResults& elements, int status);

/// Writes the body to each of the files.
/// @throws InputError  as write_elements().
void write_bodies(const BodyArguments& arguments, const BodyOutput& body, Frame frame);

}  // namespace mesamis
