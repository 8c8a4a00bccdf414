// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A .glb taken apart as its specification says.
struct Glb {
  json document;
  std::string data;

  explicit Glb(const std::filesystem::path& path) {
    const std::string bytes = read_bytes(path);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(bytes, 4), 2u);
    EXPECT_EQ(number(bytes, 8), bytes.size());
    const std::size_t size = number(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(size % 4, 0u);
    document = json::parse(bytes.substr(20, size));
    EXPECT_EQ(number(bytes, 20 + size) % 4, 0u);
    EXPECT_EQ(bytes.substr(24 + size, 4), std::string("BIN\0", 4));
    data = bytes.substr(28 + size);
    EXPECT_EQ(document["buffers"][0]["byteLength"], data.size());
  }

  static std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  }

  template <class Number>
  std::vector<Number> values(int accessor) const {
    const json& a = document["accessors"][static_cast<std::size_t>(accessor)];
    const json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<Number> out(view["byteLength"].get<std::size_t>() / sizeof(Number));
    std::memcpy(out.data(), data.data() + view["byteOffset"].get<std::size_t>(),
                out.size() * sizeof(Number));
    return out;
  }

  /// The surface of a mesh, in metres with y up.
  TriMesh surface(std::size_t mesh) const {
    const json& primitive = document["meshes"][mesh]["primitives"][0];
    const auto p = values<float>(primitive["attributes"]["POSITION"]);
    const auto t = values<std::uint32_t>(primitive["indices"]);
    TriMesh out;
    // The root's quaternion turns z up into y up.
    for (std::size_t n = 0; n < p.size(); n += 3) {
      out.points.push_back(1e-3 * Vec3{p[n], p[n + 2], -p[n + 1]});
    }
    for (std::size_t n = 0; n < t.size(); n += 3) {
      out.triangles.push_back(
          {static_cast<Index>(t[n]), static_cast<Index>(t[n + 1]), static_cast<Index>(t[n + 2])});
    }
    return out;
  }
};

TEST(Glb, ObjectsHaveNamesColoursAndNormals) {
  const TempFolder folder;
  const std::vector<NamedSurface> objects{{"hip", {255, 0, 0}, 4, cube({0, 0, 0}, 10)},
                                          {"H\xc3\xbc"
                                           "fte \"2\"",
                                           {0, 188, 255},
                                           7,
                                           cube({20, 0, 0}, 5)}};
  write_objects(folder / "a.glb", objects, {.name = "all"});
  const Glb glb(folder / "a.glb");
  EXPECT_EQ(glb.document["asset"]["version"], "2.0");
  EXPECT_EQ(glb.document["asset"]["extras"]["SPACE"], "LPS");
  EXPECT_EQ(glb.document["nodes"][0]["name"], "all");
  EXPECT_EQ(glb.document["nodes"][0]["children"], json({1, 2}));
  EXPECT_EQ(glb.document["nodes"][2]["name"],
            "H\xc3\xbc"
            "fte \"2\"");
  EXPECT_EQ(glb.document["nodes"][1]["extras"]["label"], 4);
  const json colour = glb.document["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"];
  EXPECT_NEAR(colour[1].get<double>(), 0.5029, 1e-3);  // linear light of 188
  EXPECT_EQ(colour[2], 1.0);
  const SurfaceCheck check = check_surface(glb.surface(0));
  EXPECT_TRUE(check.closed());
  EXPECT_NEAR(check.volume, 1e-6, 1e-12);  // 1000 mm^3 in m^3, and not inside out
  const json& primitive = glb.document["meshes"][1]["primitives"][0];
  const auto normals = glb.values<float>(primitive["attributes"]["NORMAL"]);
  const auto points = glb.values<float>(primitive["attributes"]["POSITION"]);
  ASSERT_EQ(normals.size(), points.size());
  for (std::size_t n = 0; n < normals.size(); n += 3) {
    const Vec3 normal{normals[n], normals[n + 1], normals[n + 2]};
    EXPECT_NEAR(norm(normal), 1, 1e-6);
    EXPECT_GT(dot(normal, Vec3{points[n], points[n + 1], points[n + 2]} - Vec3{22.5, 2.5, 2.5}), 2);
  }
  const json& place =
      glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(place["min"], json({20.0, 0.0, 0.0}));
  EXPECT_EQ(place["max"], json({25.0, 5.0, 5.0}));
}

TEST(Glb, OneSurfaceHasGreyValuesAtItsPoints) {
  const TempFolder folder;
  const TriMesh shape = cube({}, 1);
  SurfaceWriteOptions options;
  options.grey.assign(shape.points.size(), 255);
  options.grey[0] = 0;
  write_surface(folder / "a.glb", shape, options);
  const Glb glb(folder / "a.glb");
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const auto colours = glb.values<std::uint8_t>(primitive["attributes"]["COLOR_0"]);
  EXPECT_EQ(colours[0], 0);
  EXPECT_EQ(colours[3], 255);
  EXPECT_EQ(colours[4], 255);
  EXPECT_EQ(glb.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
            json({1.0, 1.0, 1.0, 1.0}));
}

TEST(Glb, IsWrittenAndNotRead) {
  const TempFolder folder;
  write_surface(folder / "a.glb", cube({}, 1), {});
  EXPECT_REFUSED(read_surface(folder / "a.glb"), HasSubstr("found the extension \".glb\""));
  EXPECT_REFUSED(read_objects(folder / "a.glb"), HasSubstr("found the extension \".glb\""));
}

}  // namespace
}  // namespace mesamis
