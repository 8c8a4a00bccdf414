// SPDX-License-Identifier: Apache-2.0
#include "mesamis/chunk_files/multiscales.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "chunk_files/chunk_bytes.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<ScaleLevel> read(const std::string& image, bool in_ome = false) {
  const std::string list = R"({"multiscales": [)" + image + "]}";
  const auto json = nlohmann::json::parse(in_ome ? R"({"ome": )" + list + "}" : list);
  const std::filesystem::path file("attributes");
  return read_multiscales({file, json});
}

TEST(Multiscales, GivesLengthsInMillimetres) {
  for (const bool in_ome : {false, true}) {
    const auto levels = read(multiscales("micrometer"), in_ome);
    ASSERT_EQ(levels.size(), 1u);
    EXPECT_EQ(levels[0].path, "0");
    EXPECT_EQ(levels[0].spacing, (Vec3{1e-3 * 1, 1e-3 * 2, 1e-3 * 4}));
    EXPECT_EQ(levels[0].origin, (Vec3{1e-3 * 10, 1e-3 * 20, 1e-3 * 30}));
    EXPECT_THAT(levels[0].axes, ElementsAre("z", "y", "x"));
    EXPECT_THAT(levels[0].warnings, IsEmpty());
  }
  EXPECT_EQ(read(multiscales("nanometer"))[0].spacing->z, 4e-6);
  EXPECT_EQ(read(multiscales("millimetre"))[0].spacing->z, 4);
  EXPECT_EQ(read(multiscales("centimeter"))[0].spacing->z, 40);
}

TEST(Multiscales, TakesMillimetresWithAWarningWhereThereIsNoUnitOfLength) {
  EXPECT_EQ(read(multiscales(""))[0].spacing, (Vec3{1, 2, 4}));
  EXPECT_THAT(read(multiscales(""))[0].warnings[0],
              "axis x has no unit: its lengths are taken as mm");
  EXPECT_THAT(read(multiscales("pixel"))[0].warnings[2],
              "axis z has the unit \"pixel\": its lengths are taken as mm");
}

TEST(Multiscales, AppliesTheTransformOfTheImageAfterThatOfTheLevel) {
  const auto level = read(multiscales("millimeter", R"(, "coordinateTransformations":
      [{"type": "scale", "scale": [10, 10, 10]},
       {"type": "translation", "translation": [3, 2, 1]}])"))[0];
  EXPECT_EQ(level.spacing, (Vec3{10, 20, 40}));
  EXPECT_EQ(level.origin, (Vec3{101, 202, 303}));
}

TEST(Multiscales, KnowsOlderFormsWithoutLengths) {
  const auto levels = read(R"({"axes": ["t", "z", "y", "x"], "datasets": [{"path": "s0"}]})");
  EXPECT_FALSE(levels[0].spacing);
  EXPECT_THAT(levels[0].axes, ElementsAre("t", "z", "y", "x"));
  EXPECT_THAT(read(R"({"datasets": [{"path": "s0"}]})")[0].axes, IsEmpty());
}

TEST(Multiscales, RefusesWhatItCannotPlace) {
  EXPECT_REFUSED(read(R"({"axes": ["x", "y", "z"], "datasets": []})"),
                 HasSubstr("expected axes that end with z, y, x, found x, y, z"));
  EXPECT_REFUSED(read(R"({"axes": ["z", "y", "x", "c"], "datasets": []})"), HasSubstr("x, c"));
  EXPECT_REFUSED(read(R"({"datasets": []})"), HasSubstr("a list with a dataset"));
  EXPECT_REFUSED(read(R"({"axes": ["z", "y", "x"], "datasets": [{"path": "0",
      "coordinateTransformations": [{"type": "scale", "scale": [1, 1]}]}]})"),
                 HasSubstr("a list of 3 numbers"));
  EXPECT_REFUSED(read(R"({"datasets": [{"path": "0",
      "coordinateTransformations": [{"type": "affine"}]}]})"),
                 HasSubstr("expected scale or translation, found \"affine\""));
  EXPECT_REFUSED(read(R"({"datasets": [{"path": 3}]})"), HasSubstr("expected a string"));
}

}  // namespace
}  // namespace mesamis::detail
