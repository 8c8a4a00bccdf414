// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/files/memory_budget.h"

/// The one reader of XML: expat, with bounds that keep a hostile file harmless.
namespace mesamis::detail::files {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  /// The element's own characters, comments left out. A blank stands for each child, so that a
  /// child never joins two numbers into one.
  std::string text;

  /// @return  the attribute's value, empty if there is none.
  std::string attribute(std::string_view key) const;
  /// @return  the first child of this name, or null.
  const XmlElement* child(std::string_view child_name) const;
};

struct XmlOptions {
  /// Called at the end of each element but the root, with its path ("amf/object/mesh"). True: the
  /// caller has used it, and the tree does not keep it. It may throw.
  std::function<bool(const XmlElement& element, std::string_view path)> consume{};
  /// VTK's files: <AppendedData> holds bytes that are no XML; the document ends at its tag.
  bool ends_at_appended_data = false;
};

struct XmlDocument {
  XmlElement root;
  std::string_view appended;  ///< a part of the text: what follows the mark '_' in <AppendedData>
};

/// Parses a document. An external DTD may be named; it is never read.
/// @param file  for messages.
/// @param budget  of the reader. The tree is claimed as it grows, and held as far as it is kept.
/// @param text  the document, in an encoding that expat knows (UTF-8, UTF-16, Latin-1, ASCII).
/// @throws InputError  naming file and line: if the document is not well-formed, declares or uses
///                     entities other than XML's own, or exceeds a bound: 32 elements within one
///                     another, 1 MiB per tag or comment, 500 000 elements and attributes in the
///                     tree, 10 000 different names; and as MemoryBudget::claim().
///
/// Linear in the text. Memory: the texts and attributes of the tree, and about 340 bytes per
/// element and 200 per attribute.
XmlDocument parse_xml(const std::filesystem::path& file, std::string_view text,
                      MemoryBudget& budget, const XmlOptions& options = {});

/// The text that an XML reader would find in these characters of an element; the characters
/// themselves where they are not well-formed.
std::string xml_unescaped(const std::string& text);

}  // namespace mesamis::detail::files
