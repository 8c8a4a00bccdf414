// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/detail/xml.h"

#include <algorithm>

#include "mesamis/io/detail/refuse.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlank = " \t\r\n";

/// As much of XML as such files have: elements, attributes, text, comments, declarations.
class XmlParser {
 public:
  XmlParser(const fs::path& file, std::string_view text) : file_(file), rest_(text) {}

  XmlElement parse_root() {
    skip_to_element();
    return parse_element(0);
  }
  /// What follows the mark '_' in <AppendedData>: the parser stops there, it is no XML.
  std::string_view appended() const { return appended_; }

 private:
  [[noreturn]] void refuse_xml(const char* what) const { refuse(file_, say("broken XML: ", what)); }

  std::string_view take_until(std::string_view end) {
    const auto at = rest_.find(end);
    if (at == rest_.npos) refuse_xml("the file ends within an element");
    const std::string_view before = rest_.substr(0, at);
    rest_.remove_prefix(at + end.size());
    return before;
  }

  /// Leaves the rest at '<' of an element's begin or end; gives the text before it, or before the
  /// first comment or declaration.
  std::string_view skip_to_element() {
    std::string_view text;
    for (bool first = true;; first = false) {
      const auto at = rest_.find('<');
      if (at == rest_.npos) refuse_xml("expected an element, found the end of the file");
      if (first) text = rest_.substr(0, at);
      rest_.remove_prefix(at);
      if (rest_.starts_with("<!--")) {
        take_until("-->");
      } else if (rest_.starts_with("<?") || rest_.starts_with("<!")) {
        take_until(">");
      } else {
        return text;
      }
    }
  }

  std::string_view take_name() {
    const auto end = rest_.find_first_of(" \t\r\n/>=<\"'");
    if (end == 0 || end == rest_.npos) refuse_xml("expected a name");
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return name;
  }

  void skip_blank() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
  }

  void parse_attribute(XmlElement& element) {
    const std::string key(take_name());
    skip_blank();
    if (!rest_.starts_with('=')) refuse_xml("expected = after the name of an attribute");
    rest_.remove_prefix(1);
    skip_blank();
    if (!rest_.starts_with('"') && !rest_.starts_with('\'')) refuse_xml("expected a quoted value");
    const std::string_view quote = rest_.substr(0, 1);
    rest_.remove_prefix(1);
    element.attributes[key] = take_until(quote);
  }

  XmlElement parse_element(int depth) {
    constexpr int kDeepest = 32;
    if (depth > kDeepest) refuse_xml("too many elements within one another");
    rest_.remove_prefix(1);
    XmlElement element;
    element.name = take_name();
    for (skip_blank(); !rest_.starts_with('>') && !rest_.starts_with("/>"); skip_blank()) {
      parse_attribute(element);
    }
    const bool empty = rest_.starts_with('/');
    rest_.remove_prefix(empty ? 2 : 1);
    if (!empty) parse_content(element, depth);
    return element;
  }

  void parse_content(XmlElement& element, int depth) {
    if (element.name == "AppendedData") {
      take_until("_");
      appended_ = rest_;
      rest_ = {};
      return;
    }
    element.text = skip_to_element();
    while (!rest_.starts_with("</")) {
      element.children.push_back(parse_element(depth + 1));
      if (element.children.back().name == "AppendedData") return;
      skip_to_element();
    }
    if (trimmed(take_until(">").substr(2)) != element.name) refuse_xml("an element is not closed");
  }

  const fs::path& file_;
  std::string_view rest_, appended_;
};

}  // namespace

std::string XmlElement::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

XmlElement parse_xml(const fs::path& file, std::string_view text, std::string_view* appended) {
  XmlParser parser(file, text);
  XmlElement root = parser.parse_root();
  if (appended != nullptr) *appended = parser.appended();
  return root;
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace mesamis::detail
