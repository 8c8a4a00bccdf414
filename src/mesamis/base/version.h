// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mesamis {

/// The version of the library, "0.1.0".
const char* version();

/// The commit it was built from, as git describes it; "unknown" outside a checkout.
const char* commit();

}  // namespace mesamis
