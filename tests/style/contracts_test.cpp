// SPDX-License-Identifier: Apache-2.0
// The contracts of the doors: each function has a comment, and few parameters.
//
// A function is judged by its declaration and its comment alone. Operators, destructors, defaulted
// functions and overrides are left out: they keep the contract of the language or of the base
// class.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "style/door_functions.h"
#include "style/rooms.h"

namespace mesamis {
namespace {

constexpr std::size_t kMostParameters = 4;

/// Doors for other rooms, not installed, of which some functions still have no comment.
const std::set<std::string> kUncommented{
    "decimate/single_places.h", "files/file_list.h",    "files/json_value.h",
    "files/memory_budget.h",    "files/number_type.h",  "files/refuse.h",
    "fit/surface_moves.h",      "method/passes.h",      "picture/raster.h",
    "surface/disjoint_sets.h",  "surface/half_edges.h", "volume_files/formats.h"};

bool has(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex(pattern, std::regex::icase));
}

bool is_left_out(const DoorFunction& f) {
  const bool is_operator = has(f.name, "^operator[^a-z(]") && f.name != "operator()";
  return is_operator || f.name[0] == '~' || has(f.qualifiers, "\\boverride\\b|= default|= delete");
}

struct Tally {
  int functions = 0;
  std::string missing;  ///< one line per function that leaves something out

  void add(const std::string& header, const DoorFunction& f) {
    ++functions;
    if (f.doc.empty()) note(header, f, "no comment");
    if (f.params.size() > kMostParameters) note(header, f, "more than four parameters");
  }

 private:
  void note(const std::string& header, const DoorFunction& f, const std::string& what) {
    missing += "  " + header + ":" + std::to_string(f.line) + " " + f.name + ": " + what + "\n";
  }
};

TEST(Contracts, OfEveryDoorHaveACommentAndFewParameters) {
  Tally tally;
  for (const auto& [name, room] : read_rooms()) {
    for (const auto& door : room.doors) {
      const std::string text = file_text(room.folder / door);
      if (kUncommented.count(name + "/" + door)) continue;
      for (const DoorFunction& f : parse_door(text)) {
        if (!is_left_out(f)) tally.add(name + "/" + door, f);
      }
    }
  }
  EXPECT_GT(tally.functions, 100);
  EXPECT_EQ(tally.missing, "");
}

/// The parser on one of each kind of declaration.
TEST(Contracts, AreReadFromEveryKindOfDeclaration) {
  const auto functions = parse_door(R"(
    #pragma once
    namespace mesamis {
    inline constexpr double kHalf = 0.5 * (1 + 0);
    using Call = std::function<bool(int)>;
    /// Free, with a default.
    /// @throws InputError  never.
    std::vector<std::array<int, 2>> free(std::span<const double, 3> a, int b = f(1, 2));
    struct Value {
      std::function<double(int, int)> crossing{};
      int list[2] = {1, 2};
      double length() const { return x; }  ///< mm
      friend bool operator==(const Value&, const Value&) = default;
    };
    /// Not the constructor's.
    class Owner final : public Base<int> {
     public:
      explicit Owner(int n) : Base<int>(n), values_{n} { fill(); }
      ~Owner() override;
      Vec3 operator()(const Vec3& p) const noexcept;
     private:
      void hidden();
    };
    template <class T, class = std::enable_if_t<(sizeof(T) > 1)>>
    T twice(T x);
    })");
  std::vector<std::string> names;
  for (const auto& f : functions) names.push_back(f.scope + "." + f.name);
  EXPECT_THAT(names, testing::ElementsAre(".free", "Value.length", "Owner.Owner", "Owner.~Owner",
                                          "Owner.operator()", ".twice"));
  EXPECT_THAT(functions[0].params,
              testing::ElementsAre("std :: span < const double , 3 > a", "int b = f ( 1 , 2 )"));
  EXPECT_EQ(functions[0].doc, " Free, with a default.\n @throws InputError  never.\n");
  EXPECT_EQ(functions[1].doc, " mm\n");
  EXPECT_EQ(functions[2].doc, "");
  EXPECT_EQ(functions[2].body, "{ fill ( ) ; }");
  EXPECT_EQ(functions[4].qualifiers, "const noexcept");
}

}  // namespace
}  // namespace mesamis
