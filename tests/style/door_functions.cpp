// SPDX-License-Identifier: Apache-2.0
#include "style/door_functions.h"

#include <cctype>
#include <stdexcept>

namespace mesamis {
namespace {

enum class Kind { kWord, kMark, kLiteral, kDoc, kTrailingDoc };

struct Token {
  Kind kind;
  std::string text;
  int line;
};

bool is_word_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Cuts a header into tokens; leaves out plain comments and preprocessor lines.
class Lexer {
 public:
  explicit Lexer(const std::string& text) : text_(text) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) next();
    return std::move(tokens_);
  }

 private:
  void next() {
    const char c = text_[at_];
    if (c == '\n') ++line_;
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++at_;
    } else if (c == '#') {
      skip_directive();
    } else if (text_.compare(at_, 2, "//") == 0) {
      comment();
    } else if (text_.compare(at_, 2, "/*") == 0) {
      block_comment();
    } else if (c == '"' || (c == '\'' && !is_word_char(text_[at_ - 1]))) {
      literal(c);
    } else if (is_word_char(c)) {
      word();
    } else {
      mark();
    }
  }

  void add(Kind kind, std::size_t end) {
    tokens_.push_back({kind, text_.substr(at_, end - at_), line_});
    at_ = end;
  }

  std::size_t line_end() const { return std::min(text_.find('\n', at_), text_.size()); }

  void skip_directive() {
    std::size_t end = line_end();
    while (end < text_.size() && text_[end - 1] == '\\') {
      ++line_;
      end = std::min(text_.find('\n', end + 1), text_.size());
    }
    at_ = end;
  }

  void comment() {
    const std::size_t end = line_end();
    if (text_.compare(at_, 4, "///<") == 0) return add(Kind::kTrailingDoc, end);
    if (text_.compare(at_, 3, "///") == 0) return add(Kind::kDoc, end);
    at_ = end;
  }

  void block_comment() {
    const std::size_t end = std::min(text_.find("*/", at_) + 2, text_.size());
    for (; at_ < end; ++at_) line_ += text_[at_] == '\n';
  }

  void literal(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote) end += text_[end] == '\\' ? 2 : 1;
    add(Kind::kLiteral, std::min(end + 1, text_.size()));
  }

  void word() {
    std::size_t end = at_;
    while (end < text_.size() && (is_word_char(text_[end]) || text_[end] == '\'')) ++end;
    add(Kind::kWord, end);
  }

  void mark() {
    const bool two = text_.compare(at_, 2, "::") == 0 || text_.compare(at_, 2, "->") == 0;
    add(Kind::kMark, at_ + (two ? 2 : 1));
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

bool opens(const std::string& t) { return t == "(" || t == "[" || t == "{"; }
bool closes(const std::string& t) { return t == ")" || t == "]" || t == "}"; }

std::string joined(const std::vector<Token>& tokens, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i) text += (text.empty() ? "" : " ") + tokens[i].text;
  return text;
}

/// Walks the scopes of a header and notes what is declared there.
class Parser {
 public:
  explicit Parser(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  std::vector<DoorFunction> run() {
    while (at_ < tokens_.size()) statement("", "");
    return std::move(functions_);
  }

 private:
  const std::string& text(std::size_t i) const {
    static const std::string none;
    return i < tokens_.size() ? tokens_[i].text : none;
  }
  bool is(const char* t) const { return text(at_) == t; }
  bool is_doc(std::size_t i) const {
    return i < tokens_.size() &&
           (tokens_[i].kind == Kind::kDoc || tokens_[i].kind == Kind::kTrailingDoc);
  }

  /// One past the bracket that matches the one at i.
  std::size_t past_match(std::size_t i) const {
    int depth = 0;
    for (; i < tokens_.size(); ++i) {
      if (is_doc(i)) continue;
      depth += opens(text(i));
      depth -= closes(text(i));
      if (depth == 0) return i + 1;
    }
    throw std::runtime_error("a bracket is not closed");
  }

  /// One past the '>' that matches the '<' at i.
  std::size_t past_angle(std::size_t i) const {
    int depth = 0;
    while (i < tokens_.size()) {
      depth += text(i) == "<";
      depth -= text(i) == ">";
      i = opens(text(i)) ? past_match(i) : i + 1;
      if (depth == 0) return i;
    }
    throw std::runtime_error("an angle bracket is not closed");
  }

  void skip_past_semicolon() {
    while (at_ < tokens_.size() && !is(";")) at_ = opens(text(at_)) ? past_match(at_) : at_ + 1;
    ++at_;
  }

  std::string read_doc() {
    std::string doc;
    for (; is_doc(at_); ++at_) {
      if (tokens_[at_].kind == Kind::kDoc) doc += tokens_[at_].text.substr(3) + "\n";
    }
    return doc;
  }

  /// One declaration of a namespace or a class with everything in it.
  void statement(const std::string& scope, const std::string& class_name) {
    const std::string doc = read_doc();
    while (is("template")) at_ = past_angle(at_ + 1);
    if (is("requires")) at_ = past_match(at_ + 1);
    if (at_ >= tokens_.size()) return;
    if (is("namespace")) {
      while (!is("{")) ++at_;
      block(scope, "", true);
    } else if (is("using") || is("friend") || is("static_assert") || is("enum") || is(";")) {
      friend_or_other();
    } else if ((is("class") || is("struct")) && defines_class()) {
      class_definition(scope);
    } else {
      declaration(scope, class_name, doc);
    }
  }

  /// Leaves out everything to the semicolon, or to the end of the inline body of a friend.
  void friend_or_other() {
    const bool may_have_body = is("friend");
    while (at_ < tokens_.size() && !is(";")) {
      const bool body = is("{");
      at_ = opens(text(at_)) ? past_match(at_) : at_ + 1;
      if (body && may_have_body) return;
    }
    ++at_;
  }

  bool defines_class() const {
    for (std::size_t i = at_; i < tokens_.size(); ++i) {
      if (text(i) == "{") return true;
      if (text(i) == ";" || text(i) == "(") return false;
    }
    return false;
  }

  void class_definition(const std::string& scope) {
    const bool is_public = is("struct");
    std::string name;
    for (++at_; !is("{") && !is(":"); ++at_) {
      if (is("alignas")) at_ = past_match(at_ + 1);
      if (!is("final")) name = text(at_);
    }
    while (!is("{")) ++at_;
    block(scope.empty() ? name : scope + "::" + name, name, is_public);
    skip_past_semicolon();
  }

  /// The statements between braces; in a class those of its public parts count.
  void block(const std::string& scope, const std::string& class_name, bool is_public) {
    const std::size_t end = past_match(at_) - 1;
    ++at_;
    while (at_ < end) {
      if ((is("public") || is("private") || is("protected")) && text(at_ + 1) == ":") {
        is_public = is("public");
        at_ += 2;
        continue;
      }
      const std::size_t known = functions_.size();
      statement(scope, class_name);
      if (!is_public) functions_.resize(known);
    }
    at_ = end + 1;
  }

  /// The '(' of the parameters, if a function is declared here; else 0.
  std::size_t find_parameters() const {
    for (std::size_t i = at_; i < tokens_.size();) {
      const std::string& t = text(i);
      if (t == "operator") {
        const std::size_t first = i + 1;
        for (i = first + 1; text(i) != "("; ++i) {
        }
        return i;
      }
      if (t == "(") return i > at_ ? i : 0;
      if (t == "=" || t == ";" || t == "{" || t == ":") return 0;
      i = t == "<" ? past_angle(i) : t == "[" ? past_match(i) : i + 1;
    }
    return 0;
  }

  void declaration(const std::string& scope, const std::string& class_name,
                   const std::string& doc) {
    const std::size_t open = find_parameters();
    if (open == 0) return skip_past_semicolon();
    DoorFunction f{tokens_[at_].line, scope, "", "", "", "", doc, {}};
    std::size_t name = open - 1;
    for (std::size_t i = at_; i < open; ++i) {
      if (text(i) == "operator") name = i;
    }
    if (name > at_ && text(name - 1) == "~") --name;
    for (std::size_t i = name; i < open; ++i) f.name += text(i);
    f.result = joined(tokens_, at_, name);
    f.params = parameters(open);
    at_ = past_match(open);
    read_rest(f, f.name == class_name);
    functions_.push_back(f);
  }

  std::vector<std::string> parameters(std::size_t open) const {
    std::vector<std::string> params;
    const std::size_t end = past_match(open) - 1;
    std::size_t begin = open + 1;
    for (std::size_t i = begin; i < end;) {
      const std::string& t = text(i);
      if (t == ",") {
        params.push_back(joined(tokens_, begin, i));
        begin = i + 1;
      }
      i = t == "<" ? past_angle(i) : opens(t) ? past_match(i) : i + 1;
    }
    if (begin < end) params.push_back(joined(tokens_, begin, end));
    return params;
  }

  /// Qualifiers, initialiser list, body or semicolon, and a comment at the end of the line.
  void read_rest(DoorFunction& f, bool is_constructor) {
    const std::size_t begin = at_;
    while (!is(";") && !is("{") && !is(":")) at_ = is("(") ? past_match(at_) : at_ + 1;
    f.qualifiers = joined(tokens_, begin, at_);
    if (is(":") && is_constructor) skip_initialisers();
    int last_line = tokens_[at_].line;
    if (is("{")) {
      const std::size_t end = past_match(at_);
      f.body = joined(tokens_, at_, end);
      last_line = tokens_[end - 1].line;
      at_ = end;
    } else {
      ++at_;
    }
    if (is_doc(at_) && tokens_[at_].kind == Kind::kTrailingDoc && tokens_[at_].line == last_line) {
      f.doc += tokens_[at_].text.substr(4) + "\n";
    }
  }

  /// From ':' to the '{' of the body: each initialiser is a name with one pair of brackets.
  void skip_initialisers() {
    do {
      ++at_;
      while (!is("(") && !is("{")) at_ = is("<") ? past_angle(at_) : at_ + 1;
      at_ = past_match(at_);
    } while (is(","));
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::vector<DoorFunction> functions_;
};

}  // namespace

std::vector<DoorFunction> parse_door(const std::string& header) {
  return Parser(Lexer(header).run()).run();
}

}  // namespace mesamis
