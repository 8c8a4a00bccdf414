// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace mesamis {

/// A public function or public member function as a header declares it.
struct DoorFunction {
  int line = 0;                     ///< of its name's declaration, from 1
  std::string scope;                ///< class names, "A::B"; empty for a free function
  std::string name;                 ///< "operator+", "~X" included
  std::string result;               ///< the words before the name, separated by spaces
  std::string qualifiers;           ///< the words after the parameters: "const noexcept = default"
  std::string body;                 ///< tokens of an inline body, separated by spaces
  std::string doc;                  ///< the /// lines before it and the ///< after it
  std::vector<std::string> params;  ///< tokens of each parameter, separated by spaces
};

/// Finds the functions that a header in the project's style declares at namespace scope or in the
/// public part of a class.
///
/// It knows namespaces, classes, templates, default arguments, initialiser lists and inline bodies;
/// it does not expand macros and does not know functions that return functions.
/// @param header  the header's text.
/// @return in the order of the header; friends and using-declarations are left out.
/// @throws std::runtime_error  if brackets do not match.
std::vector<DoorFunction> parse_door(const std::string& header);

}  // namespace mesamis
