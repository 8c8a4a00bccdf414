// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/Validators.hpp>
#include <string>

/// Checks of numbers on the command line. Messages and help name a range in words: "above 0".
namespace mesamis {

/// A number above 0.
CLI::Validator above_zero();

/// A number that is 0 or more.
CLI::Validator zero_or_more();

/// A number from low to high, ends included, in the unit of the option.
CLI::Validator from_to(double low, double high);

}  // namespace mesamis
