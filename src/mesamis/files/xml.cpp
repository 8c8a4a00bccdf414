// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/xml.h"

#include <expat.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <unordered_set>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepest = 32;
constexpr std::size_t kMostItems = 500'000;   // elements and attributes in the tree at once
constexpr std::size_t kMostNames = 10'000;    // expat keeps each name until the end
constexpr std::size_t kLongestTag = 1 << 20;  // expat holds an unfinished tag in memory
constexpr std::size_t kChunk = 1 << 16;

using Attribute = std::pair<std::string, std::string>;

std::size_t items_in(const XmlElement& element) {
  std::size_t items = 1 + element.attributes.size();
  for (const XmlElement& child : element.children) items += items_in(child);
  return items;
}

/// Builds the tree from expat's events. No exception may pass through expat, which is C: a handler
/// keeps it and stops the parser.
class XmlBuilder {
 public:
  XmlBuilder(const fs::path& file, std::string_view text, MemoryBudget& budget,
             const XmlOptions& options)
      : file_(file),
        text_(text),
        budget_(budget),
        options_(options),
        parser_(XML_ParserCreate(nullptr)) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          guarded(self, [&](XmlBuilder& b) { b.begin_element(name, attributes); });
        },
        [](void* self, const XML_Char*) { guarded(self, [](XmlBuilder& b) { b.end_element(); }); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* part, int size) {
      guarded(self, [&](XmlBuilder& b) { b.add_text(part, static_cast<std::size_t>(size)); });
    });
    XML_SetStartDoctypeDeclHandler(parser_.get(), [](void* self, const XML_Char*, const XML_Char*,
                                                     const XML_Char*, int has_subset) {
      guarded(self, [&](XmlBuilder& b) { b.begin_doctype(has_subset != 0); });
    });
    XML_SetSkippedEntityHandler(parser_.get(), [](void* self, const XML_Char* name, int) {
      guarded(self, [&](XmlBuilder& b) { b.refuse_entity(name); });
    });
  }

  XmlDocument parse() {
    for (std::size_t at = 0; at < text_.size() && !stopped_; at += kChunk) {
      feed(text_.substr(at, kChunk), at + kChunk >= text_.size());
      require_short_tag(std::min(at + kChunk, text_.size()));
    }
    if (text_.empty()) feed({}, true);
    while (open_.size() > 1) close_element();
    return {std::move(open_.front()), appended_};
  }

 private:
  struct FreeParser {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  template <class Handler>
  static void guarded(void* self, Handler handler) {
    auto& builder = *static_cast<XmlBuilder*>(self);
    if (builder.stopped_) return;
    try {
      handler(builder);
    } catch (...) {
      builder.error_ = std::current_exception();
      builder.stop();
    }
  }

  void stop() {
    stopped_ = true;
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  [[noreturn]] void refuse_xml(const std::string& what) const {
    refuse(file_,
           message("broken XML in line ", XML_GetCurrentLineNumber(parser_.get()), ": ", what));
  }

  void feed(std::string_view chunk, bool last) {
    const XML_Status status =
        XML_Parse(parser_.get(), chunk.data(), static_cast<int>(chunk.size()), last);
    if (error_) std::rethrow_exception(error_);
    if (stopped_ || status == XML_STATUS_OK) return;
    const XML_Error code = XML_GetErrorCode(parser_.get());
    if (code == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    refuse_xml(message("expected well-formed XML, found an error: ", XML_ErrorString(code)));
  }

  void require_short_tag(std::size_t fed) const {
    const auto place = XML_GetCurrentByteIndex(parser_.get());
    if (stopped_ || place < 0 || fed - static_cast<std::size_t>(place) <= kLongestTag) return;
    refuse_xml(message("expected a tag or comment of at most ", kLongestTag,
                       " bytes, found a longer one"));
  }

  void begin_element(const XML_Char* name, const XML_Char** attributes) {
    if (open_.size() == kDeepest) {
      refuse_xml(
          message("expected at most ", kDeepest, " elements within one another, found more"));
    }
    costs_.push_back(0);
    claim(3 * sizeof(XmlElement) + std::strlen(name));  // lists double their room
    XmlElement element;
    element.name = name;
    require_known(element.name);
    for (; *attributes != nullptr; attributes += 2) {
      claim(3 * sizeof(Attribute) + std::strlen(attributes[0]) + std::strlen(attributes[1]));
      element.attributes.emplace_back(attributes[0], attributes[1]);
      require_known(element.attributes.back().first);
    }
    if (has_doctype_) refuse_entities_in_tag();
    items_ += 1 + element.attributes.size();
    if (items_ > kMostItems) {
      refuse_xml(message("expected at most ", kMostItems, " elements and attributes, found more"));
    }
    (path_ += path_.empty() ? "" : "/") += element.name;
    const bool is_end = options_.ends_at_appended_data && element.name == "AppendedData";
    open_.push_back(std::move(element));
    if (is_end) begin_appended_data();
  }

  /// On account of the innermost open element.
  void claim(std::size_t bytes) {
    budget_.claim(1, bytes, "elements of XML");
    costs_.back() += bytes;
  }

  void add_text(const XML_Char* part, std::size_t size) {
    claim(2 * size);  // a string doubles its room
    open_.back().text.append(part, size);
  }

  /// Where a DTD is named but not read, expat drops an unknown entity in an attribute silently.
  void refuse_entities_in_tag() const {
    const auto begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
    const auto size = static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
    const std::string_view tag = text_.substr(begin, size);
    for (std::size_t at = 0; (at = tag.find('&', at)) != tag.npos; ++at) {
      const std::string_view name = tag.substr(at + 1);
      const bool is_known = name.starts_with('#') || name.starts_with("amp;") ||
                            name.starts_with("lt;") || name.starts_with("gt;") ||
                            name.starts_with("quot;") || name.starts_with("apos;");
      if (!is_known)
        refuse_entity(std::string(name.substr(0, name.find_first_of(";\"' "))).c_str());
    }
  }

  void require_known(const std::string& name) {
    if (names_.insert(name).second && names_.size() > kMostNames) {
      refuse_xml(message("expected at most ", kMostNames, " different names, found more"));
    }
  }

  void begin_appended_data() {
    const auto tag = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
    const auto size = static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
    const std::size_t mark = text_.find('_', tag + size);
    if (mark == text_.npos) refuse_xml("expected the mark _ in <AppendedData>, found none");
    appended_ = text_.substr(mark + 1);
    stop();
  }

  void end_element() {
    if (open_.size() > 1) close_element();  // the root stays
  }

  void close_element() {
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    XmlElement& parent = open_.back();
    parent.text += ' ';
    const bool consumed = options_.consume && options_.consume(element, path_);
    path_.resize(path_.size() - element.name.size() - 1);
    const std::size_t cost = costs_.back();
    costs_.pop_back();
    if (consumed) {
      items_ -= items_in(element);
      budget_.give_back(cost);
    } else {
      costs_.back() += cost;
      parent.children.push_back(std::move(element));
    }
  }

  void begin_doctype(bool has_subset) {
    has_doctype_ = true;
    if (has_subset) refuse_xml("expected no declarations of entities, found a DTD that holds some");
  }

  void refuse_entity(const XML_Char* name) const {
    refuse_xml(message("expected a character or one of XML's own entities, found ",
                       in_quotes(message('&', name, ';'))));
  }

  const fs::path& file_;
  std::string_view text_, appended_;
  MemoryBudget& budget_;
  const XmlOptions& options_;
  std::unique_ptr<XML_ParserStruct, FreeParser> parser_;
  std::vector<XmlElement> open_;    // the root and the open elements within one another
  std::vector<std::size_t> costs_;  // of each of these, with what it keeps, bytes
  std::string path_;                // of the innermost open element
  std::unordered_set<std::string> names_;
  std::size_t items_ = 0;
  std::exception_ptr error_;
  bool stopped_ = false, has_doctype_ = false;
};

}  // namespace

std::string XmlElement::attribute(std::string_view key) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [key](const auto& attribute) { return attribute.first == key; });
  return found == attributes.end() ? "" : found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

XmlDocument parse_xml(const fs::path& file, std::string_view text, MemoryBudget& budget,
                      const XmlOptions& options) {
  return XmlBuilder(file, text, budget, options).parse();
}

std::string xml_unescaped(const std::string& text) {
  if (text.find('&') == text.npos) return text;
  constexpr double kMostGigabytes = 1;  // of one text, which is in memory
  MemoryBudget budget({}, {kMostGigabytes});
  try {
    return parse_xml({}, "<x>" + text + "</x>", budget).root.text;
  } catch (const InputError&) {
    return text;
  }
}

}  // namespace mesamis::detail::files
