// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mesamis::detail {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::string_view text;  ///< up to the first child

  /// The attribute's value or an empty text.
  std::string attribute(const std::string& key) const;
  /// The first child of this name, or null.
  const XmlElement* child(std::string_view child_name) const;
};

/// The root element of a file. As much of XML as VTK's and AMF files have: elements, attributes,
/// text, comments, declarations; entities stay as they are.
/// @param file      for messages
/// @param text      must live on.
/// @param appended  optional: what follows the mark '_' in an element <AppendedData>, where the
///                  parser stops, for it is no XML.
/// @throws InputError  if it is broken or nested too deeply.
XmlElement parse_xml(const std::filesystem::path& file, std::string_view text,
                     std::string_view* appended = nullptr);

/// Text as an XML element or attribute holds it.
std::string xml_escaped(std::string_view text);

}  // namespace mesamis::detail
