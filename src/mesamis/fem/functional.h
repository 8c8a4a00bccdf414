// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/fem/p1_space.h"

namespace mesamis::detail::fem {

/// Parameters of the Ambrosio-Tortorelli functional (2). Lengths are in the mesh's own unit,
/// grey values in [0, 255].
struct AtParameters {
  double epsilon = 1e-3;  ///< thickness of the edge indicator, > 0
  double eta = 1e-6;      ///< keeps the u-step elliptic where v = 0, > 0; epsilon^2 in the paper
  double beta = 2;        ///< weight of smoothness away from edges, > 0; a length squared
  double gamma = 0.1;     ///< price of edges, > 0; grey value squared times length
};

/// Checks the parameters.
/// @throws InputError  unless all are finite and positive, naming the first that is not.
void require_valid(const AtParameters& parameters);

/// The fields of the functional on one mesh, one value per node each. They refer to the caller's
/// values.
struct AtFields {
  std::span<const double> u;  ///< denoised image, grey values
  std::span<const double> v;  ///< edge indicator: 0 at edges, 1 away from them
  std::span<const double> f;  ///< the image, grey values
};

/// The three parts of the discrete functional (4); grey value squared times volume.
struct Energy {
  double fidelity = 0;   ///< int P_h((u - f)^2)
  double smoothing = 0;  ///< beta int (P_h(v^2) + eta) |grad u|^2
  double edge = 0;       ///< gamma int (eps |grad v|^2 + P_h((v - 1)^2) / (4 eps))
  /// The functional itself, grey value squared times volume.
  double total() const noexcept { return fidelity + smoothing + edge; }
};

/// Evaluates the discrete functional (4). Source: paper, sec. 2.
/// @param fields  n values each, n the nodes of the space.
/// @return grey value squared times volume; volumes in the mesh's own unit.
///
/// Summed in blocks: the same bits for any number of threads.
Energy energy(const P1Space& space, const AtParameters& parameters, const AtFields& fields);

}  // namespace mesamis::detail::fem
