// SPDX-License-Identifier: Apache-2.0
// The contracts of the doors: what the comment of each public function says.
//
// A function is judged by its declaration and its comment alone. Operators, destructors, defaulted
// functions and overrides are left out: they keep the contract of the language or of the base
// class.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "style/door_functions.h"
#include "style/rooms.h"

namespace mesamis {
namespace {

constexpr std::size_t kMostParameters = 4;

bool has(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex(pattern, std::regex::icase));
}

/// All that the signature names: types and parameter names.
std::string signature(const DoorFunction& f) {
  std::string text = f.result + " (";
  for (const auto& param : f.params) text += param + " , ";
  return text + ")";
}

bool is_left_out(const DoorFunction& f) {
  const bool is_operator = has(f.name, "^operator[^a-z(]") && f.name != "operator()";
  return is_operator || f.name[0] == '~' || has(f.qualifiers, "\\boverride\\b|= default|= delete");
}

bool is_inline_without_loop(const DoorFunction& f) {
  return !f.body.empty() && !has(f.body, "\\b(for|while)\\b");
}

/// Numbers with a fraction, points, matrices and boxes are measured in something.
bool takes_values(const DoorFunction& f) {
  return has(signature(f), "\\b(double|float|Vec3|Sym3|PackedSym3|Box|Spacing)\\b");
}

bool names_unit(const DoorFunction& f) {
  return has(f.doc,
             "\\bmm\\b|\\bvoxels?\\b|\\bnative\\b|\\bgr[ea]y\\b|\\bHU\\b|%|\\bpercent\\b|"
             "\\bdegrees?\\b|\\bradians?\\b|\\bbytes?\\b|\\bseconds?\\b|\\bms\\b|\\bpixels?\\b|"
             "\\bMPa\\b|\\bg/cm|\\bdpi\\b|\\bdimensionless\\b|\\bno unit\\b|\\bany "
             "unit\\b|\\bunits? of\\b") ||
         has(signature(f), "_(mm|mm2|mm3|deg|voxel|native|bytes|seconds)\\b");
}

/// noexcept and constexpr functions throw nothing; all others say so or say what they throw. That
/// memory may run out goes without saying.
bool states_throws(const DoorFunction& f) {
  return has(f.qualifiers, "\\bnoexcept\\b") || has(f.result, "\\bconstexpr\\b") ||
         has(f.doc, "@throws|never throws|throws nothing");
}

/// Functions that walk over an array of their arguments have a cost worth naming.
bool walks_arrays(const DoorFunction& f) {
  return !is_inline_without_loop(f) &&
         has(signature(f),
             "\\b(vector|span|TetMesh|TriMesh|Volume|SparseMatrix|KuhnGrid|MeshSpace)\\b");
}

bool names_cost(const DoorFunction& f) {
  return has(f.doc,
             "\\bO\\(|\\blinear time\\b|\\bcosts?\\b|\\btakes about\\b|\\bmemory\\b|\\bus per\\b");
}

struct Share {
  int kept = 0, applicable = 0;
  void count(bool applies, bool keeps) {
    applicable += applies;
    kept += applies && keeps;
  }
  double percent() const { return applicable > 0 ? 100.0 * kept / applicable : 100; }
};

/// What the functions of one room, or of all, say.
struct Tally {
  int functions = 0, undocumented = 0, crowded = 0;
  Share units, throws, cost;
  std::string missing;  ///< one line per function that leaves something out

  void add(const std::string& header, const DoorFunction& f) {
    ++functions;
    undocumented += f.doc.empty();
    crowded += f.params.size() > kMostParameters;
    units.count(takes_values(f), names_unit(f));
    throws.count(true, states_throws(f));
    cost.count(walks_arrays(f), names_cost(f));
    note(header, f);
  }

 private:
  void note(const std::string& header, const DoorFunction& f) {
    std::string what;
    if (f.doc.empty()) what += " no comment;";
    if (f.params.size() > kMostParameters) what += " more than four parameters;";
    if (takes_values(f) && !names_unit(f)) what += " no unit;";
    if (!states_throws(f)) what += " no @throws;";
    if (walks_arrays(f) && !names_cost(f)) what += " no cost;";
    if (what.empty()) return;
    missing += "  " + header + ":" + std::to_string(f.line) + " " + f.name + ":" + what + "\n";
  }
};

std::map<std::string, Tally> tally_rooms() {
  std::map<std::string, Tally> tallies;
  for (const auto& [name, room] : read_rooms()) {
    for (const auto& door : room.doors) {
      for (const DoorFunction& f : parse_door(file_text(room.folder / door))) {
        if (is_left_out(f)) continue;
        tallies[name].add(name + "/" + door, f);
        tallies["all rooms"].add(name + "/" + door, f);
      }
    }
  }
  return tallies;
}

void print_row(const std::string& room, const Tally& t) {
  std::printf(
      "%-12s %4d functions, %2d undocumented, %2d with > 4 parameters, units %3.0f %%, "
      "@throws %3.0f %%, cost %3.0f %%\n",
      room.c_str(), t.functions, t.undocumented, t.crowded, t.units.percent(), t.throws.percent(),
      t.cost.percent());
}

TEST(Contracts, OfEveryDoorLackNothing) {
  const auto tallies = tally_rooms();
  EXPECT_GT(tallies.at("all rooms").functions, 0);
  for (const auto& [room, tally] : tallies) print_row(room, tally);
  EXPECT_EQ(tallies.at("all rooms").missing, "");
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
