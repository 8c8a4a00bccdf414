// SPDX-License-Identifier: Apache-2.0
// Binary glTF 2.0 (.glb), which web viewers show: a node with a mesh and a material per object.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mesamis/files/bytes.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::shape_files {
namespace {

using nlohmann::ordered_json;

// glTF's numbers of types and targets.
constexpr int kUnsignedByte = 5121, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertices = 34962, kTriangles = 34963;

/// A share of 0 to 1 of sRGB in linear light, as glTF wants colours.
double linear(double share) {
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

/// Buffers, accessors and nodes while they grow.
class GlbBuilder {
 public:
  explicit GlbBuilder(const SurfaceWriteOptions& options) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "mesamis"}};
    for (const auto& [type, text] : options.metadata) {
      if (type == kProducer) json_["asset"]["generator"] = text;
    }
    ordered_json& facts = json_["asset"]["extras"];
    if (options.frame) facts["SPACE"] = frame_name(*options.frame);
    facts["LengthUnit"] = "mm";
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", {0}}}};
    // Coordinates stay mm with z up; glTF has metres with y up.
    const double half = std::sqrt(0.5);
    json_["nodes"] = {{{"name", options.name.empty() ? "surfaces" : options.name},
                       {"rotation", {-half, 0, 0, half}},
                       {"scale", {1e-3, 1e-3, 1e-3}},
                       {"children", ordered_json::array()}}};
  }

  /// @param grey  of each point, 0 to 255; empty: the object has its colour alone.
  void add(const NamedSurface& object, const std::vector<double>& grey) {
    const std::size_t number = json_["nodes"].size();
    ordered_json attributes;
    attributes["POSITION"] = add_points(object.surface.points);
    attributes["NORMAL"] = add_normals(object.surface);
    if (!grey.empty()) attributes["COLOR_0"] = add_grey(grey);
    const int indices = add_triangles(object.surface.triangles);
    json_["meshes"].push_back({{"name", object.name},
                               {"primitives",
                                {{{"attributes", attributes},
                                  {"indices", indices},
                                  {"material", add_material(object, grey.empty())}}}}});
    json_["nodes"].push_back({{"name", object.name},
                              {"mesh", json_["meshes"].size() - 1},
                              {"extras", {{"label", object.label}}}});
    json_["nodes"][0]["children"].push_back(number);
  }

  std::string bytes() {
    json_["buffers"] = {{{"byteLength", data_.size()}}};
    std::string text = json_.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out;
    const auto number = [&](std::uint64_t n) { append(out, static_cast<std::uint32_t>(n)); };
    constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
    number(kMagic), number(2), number(12 + 8 + text.size() + 8 + data_.size());
    number(text.size()), number(kJson);
    out += text;
    number(data_.size()), number(kBinary);
    return out + data_;
  }

 private:
  /// Appends values, as a view of the buffer and an accessor.
  template <class Number>
  int add_values(const std::vector<Number>& values, int target, ordered_json accessor) {
    const std::size_t begin = data_.size();
    for (const Number value : values) append(data_, value);
    json_["bufferViews"].push_back({{"buffer", 0},
                                    {"byteOffset", begin},
                                    {"byteLength", data_.size() - begin},
                                    {"target", target}});
    data_.resize((data_.size() + 3) / 4 * 4, '\0');
    accessor["bufferView"] = json_["bufferViews"].size() - 1;
    json_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  static std::vector<float> singles(const std::vector<Vec3>& vectors) {
    std::vector<float> values;
    for (const Vec3& v : vectors) {
      for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(v[axis]));
    }
    return values;
  }

  int add_points(const std::vector<Vec3>& points) {
    const std::vector<float> values = singles(points);
    std::array<float, 3> least{values[0], values[1], values[2]}, most = least;
    for (std::size_t n = 0; n < values.size(); ++n) {
      least[n % 3] = std::min(least[n % 3], values[n]);
      most[n % 3] = std::max(most[n % 3], values[n]);
    }
    return add_values(values, kVertices,
                      {{"componentType", kFloat},
                       {"count", points.size()},
                       {"type", "VEC3"},
                       {"min", least},
                       {"max", most}});
  }

  int add_normals(const TriMesh& surface) {
    std::vector<Vec3> normals = vertex_normals(surface);
    for (Vec3& n : normals) {
      if (!(norm(n) > 0.5)) n = {0, 0, 1};  // a point of no area; glTF wants unit vectors
    }
    return add_values(singles(normals), kVertices,
                      {{"componentType", kFloat}, {"count", normals.size()}, {"type", "VEC3"}});
  }

  int add_grey(const std::vector<double>& grey) {
    std::vector<std::uint8_t> values;
    for (const double g : grey) {
      const std::uint8_t level = channel_of(linear(std::clamp(g / 255, 0.0, 1.0)));
      values.insert(values.end(), {level, level, level, 255});
    }
    return add_values(values, kVertices,
                      {{"componentType", kUnsignedByte},
                       {"normalized", true},
                       {"count", grey.size()},
                       {"type", "VEC4"}});
  }

  int add_triangles(const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> values;
    for (const Triangle& t : triangles) {
      for (const Index p : t) values.push_back(static_cast<std::uint32_t>(p));
    }
    return add_values(
        values, kTriangles,
        {{"componentType", kUnsignedInt}, {"count", values.size()}, {"type", "SCALAR"}});
  }

  std::size_t add_material(const NamedSurface& object, bool coloured) {
    std::array<double, 4> colour{1, 1, 1, 1};
    for (std::size_t c = 0; coloured && c < 3; ++c) colour[c] = linear(object.colour[c] / 255.0);
    json_["materials"].push_back(
        {{"name", object.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 0.7}}}});
    return json_["materials"].size() - 1;
  }

  ordered_json json_;
  std::string data_;
};

}  // namespace

std::string glb_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  GlbBuilder builder(options);
  NamedSurface object;
  object.name = options.name.empty() ? "surface" : options.name;
  object.surface = surface;
  builder.add(object, options.grey);
  return builder.bytes();
}

std::string glb_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options) {
  GlbBuilder builder(options);
  for (const NamedSurface& object : objects) builder.add(object, {});
  return builder.bytes();
}

}  // namespace mesamis::detail::shape_files
