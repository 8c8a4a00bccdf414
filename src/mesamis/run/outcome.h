// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/method/settings.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

namespace detail::run {
struct OutcomeDetails;
}

/// An object found by a run. It refers to its outcome.
struct OutcomeObject {
  const Segment& segment;                  ///< its name, label and colour
  const TriMesh& surface;                  ///< world frame (LPS), mm
  const SurfaceCheck& check;               ///< of the surface
  std::span<const double> expected_error;  ///< at each point of the surface, mm; empty: not known
};

/// The adapted mesh of a run. It refers to its outcome.
struct OutcomeMesh {
  const TetMesh& mesh;           ///< n nodes, world frame (LPS), mm
  std::span<const double> u, v;  ///< n values: denoised grey values, 0 to 255; edge indicator
  std::span<const double> f;     ///< n values: the image on the mesh, grey values
  std::span<const Sym3> metric;  ///< n matrices that the mesh was made for, 1/mm^2
};

/// The result of a run, of one object or of several. It is immutable; copies share their data, and
/// references into it are valid as long as one of them exists.
class Outcome {
 public:
  /// An empty outcome; segment() makes those of runs.
  Outcome() = default;
  /// Takes the details of a run.
  explicit Outcome(detail::run::OutcomeDetails details);

  /// The objects found, in the order of the request; one object is a list of one.
  std::vector<OutcomeObject> objects() const;
  /// The adapted mesh; none for a preview, or unless requested.
  std::optional<OutcomeMesh> mesh() const;
  /// The body for a solver, world frame (LPS), mm; nullptr unless requested.
  const FiniteElements* elements() const;
  /// The settings that repeat the run: those requested and those chosen.
  Settings settings_used() const;
  /// The promise that was not kept, one line: what was expected and found. Empty if all were kept.
  std::string flaw() const;
  /// The warnings, one line each.
  std::vector<std::string> warnings() const;
  /// All details, for this project's own code.
  const detail::run::OutcomeDetails& details() const { return *details_; }

 private:
  std::shared_ptr<const detail::run::OutcomeDetails> details_;
};

}  // namespace mesamis
