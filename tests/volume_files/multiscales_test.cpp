// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/multiscales.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
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

std::vector<ScaleLevel> with_labels(const std::string& labels) {
  const auto json = nlohmann::json::parse(
      R"({"multiscales": [{"datasets": [{"path": "0"}, {"path": "1"}]}], "image-label": )" +
      labels + "}");
  const std::filesystem::path file("attributes");
  return read_multiscales({file, json});
}

TEST(Multiscales, NameAndColourLabels) {
  const auto levels = with_labels(R"({"colors": [{"label-value": 2, "rgba": [255, 8, 0, 128]},
      {"label-value": 70000}], "properties": [{"label-value": 1, "area": 3, "class": "tibia"},
      {"label-value": 2, "name": "femur"}]})");
  ASSERT_EQ(levels.size(), 2U);
  for (const ScaleLevel& level : levels) {
    ASSERT_TRUE(level.labels);
    ASSERT_EQ(level.labels->size(), 3U);
    const NamedNumber& femur = level.labels->at(0);
    EXPECT_EQ(femur.number, 2);
    EXPECT_EQ(femur.name, "femur");
    EXPECT_EQ(femur.colour, (std::array<std::uint8_t, 3>{255, 8, 0}));
    EXPECT_EQ(level.labels->at(1).number, 70000);
    EXPECT_EQ(level.labels->at(2).name, "tibia");
    EXPECT_FALSE(level.labels->at(2).colour);
    EXPECT_THAT(level.warnings, IsEmpty());
  }
  EXPECT_FALSE(read(multiscales("micrometer"))[0].labels);
  EXPECT_TRUE(with_labels("{}")[0].labels);
}

TEST(Multiscales, NamesOfLabelsThatAreBrokenAreAWarning) {
  for (const char* labels :
       {R"({"colors": 3})", R"({"colors": [{"rgba": [1, 2, 3, 4]}]})",
        R"({"colors": [{"label-value": 1.5, "rgba": [1, 2, 3, 4]}]})",
        R"({"colors": [{"label-value": 1e300}]})",
        R"({"colors": [{"label-value": 1, "rgba": [1, 2]}]})",
        R"({"colors": [{"label-value": 1, "rgba": [1, 2, 256, 4]}]})", R"({"properties": [7]})"}) {
    const auto levels = with_labels(labels);
    EXPECT_THAT(levels[0].warnings, ElementsAre(HasSubstr("not all names of labels"))) << labels;
    EXPECT_TRUE(levels[0].labels) << labels;
  }
}

}  // namespace
}  // namespace mesamis
