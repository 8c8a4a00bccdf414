// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mesamis {

/// The version of the library, "0.1.0". Never throws.
const char* version();

/// The commit it was built from, as git describes it; "unknown" outside a checkout. Never throws.
const char* commit();

}  // namespace mesamis
