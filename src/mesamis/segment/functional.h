// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/fem/p1_space.h"

namespace mesamis {

/// Parameters of the Ambrosio-Tortorelli functional (2). Lengths are in the mesh's own unit,
/// grey values in [0, 255].
struct AtParameters {
  double epsilon = 1e-3;  ///< thickness of the edge indicator, > 0
  double eta = 1e-6;      ///< keeps the u-step elliptic where v = 0, > 0; epsilon^2 in the paper
  double beta = 2;        ///< weight of smoothness away from edges, > 0; a length squared
  double gamma = 0.1;     ///< price of edges, > 0; grey value squared times length
};

/// The three parts of the discrete functional (4).
struct Energy {
  double fidelity = 0;   ///< int P_h((u - f)^2)
  double smoothing = 0;  ///< beta int (P_h(v^2) + eta) |grad u|^2
  double edge = 0;       ///< gamma int (eps |grad v|^2 + P_h((v - 1)^2) / (4 eps))
  double total() const { return fidelity + smoothing + edge; }
};

/// @param u, v, f  one value per node of the space.
Energy energy(const P1Space& space, const AtParameters& parameters, std::span<const double> u,
              std::span<const double> v, std::span<const double> f);

}  // namespace mesamis
