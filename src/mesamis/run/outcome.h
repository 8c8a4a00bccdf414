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

struct OutcomeDetails;

/// An object that was found; refers to its outcome.
struct OutcomeObject {
  const Segment& segment;                  ///< its name, label and colour
  const TriMesh& surface;                  ///< world frame (LPS), mm
  const SurfaceCheck& check;               ///< of the surface
  std::span<const double> expected_error;  ///< at each point of the surface, mm; empty: not known
};

/// The adapted mesh of a run; refers to its outcome.
struct OutcomeMesh {
  const TetMesh& mesh;           ///< n nodes, world frame (LPS), mm
  std::span<const double> u, v;  ///< n values: denoised grey values, 0 to 255; edge indicator
  std::span<const double> f;     ///< n values: the image on the mesh, grey values
  std::span<const Sym3> metric;  ///< n matrices that the mesh was made for, 1/mm^2
};

/// What came out of a run, of one object or of several. It does not change; copies share what they
/// hold, and what refers to it lives as long as one of them.
class Outcome {
 public:
  /// Holds nothing: only segment() makes outcomes of runs.
  Outcome() = default;
  /// Takes over what a run has found.
  explicit Outcome(OutcomeDetails details);

  /// The objects that were found, in the order in which they were looked for; one object is a list
  /// of one.
  std::vector<OutcomeObject> objects() const;
  /// The adapted mesh; nothing for a preview, or where none was asked for.
  std::optional<OutcomeMesh> mesh() const;
  /// The body for a solver, world frame (LPS), mm; nullptr: none was asked for.
  const FiniteElements* elements() const;
  /// What the run was asked for and what it has chosen: the settings that repeat it.
  Settings settings_used() const;
  /// Which promise was not kept, on one line: what was expected and found. Empty: all were.
  std::string flaw() const;
  /// What may not be what was meant, one line each.
  std::vector<std::string> warnings() const;
  /// All of it, for the rooms and programs of this project.
  const OutcomeDetails& details() const { return *details_; }

 private:
  std::shared_ptr<const OutcomeDetails> details_;
};

}  // namespace mesamis
