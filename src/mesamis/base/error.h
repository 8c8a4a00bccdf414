// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace mesamis {

/// An argument of the caller or a file that cannot be used. The message is one line that says what,
/// where, expected and found.
class InputError : public std::runtime_error {
 public:
  /// @param message  one line.
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

/// A promise of the library could not be kept (a solve that broke down, an invalid mesh).
class NumericalError : public std::runtime_error {
 public:
  /// @param message  one line.
  explicit NumericalError(const std::string& message) : std::runtime_error(message) {}
};

/// The caller's progress function asked to stop.
class Cancelled : public std::runtime_error {
 public:
  /// The message is "cancelled".
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace mesamis
