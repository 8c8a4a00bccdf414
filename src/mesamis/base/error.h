// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace mesamis {

/// An unusable argument or file. The message is one line that says what, where, expected and found.
class InputError : public std::runtime_error {
 public:
  /// @param message  one line.
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

/// The library cannot keep a promise (a solve that breaks down, an invalid mesh).
class NumericalError : public std::runtime_error {
 public:
  /// @param message  one line.
  explicit NumericalError(const std::string& message) : std::runtime_error(message) {}
};

/// The caller's progress function stopped the computation.
class Cancelled : public std::runtime_error {
 public:
  /// The message is "cancelled".
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace mesamis
