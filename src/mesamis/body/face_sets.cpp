// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/face_sets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

using Kind = FaceQuery::Kind;

[[noreturn]] void refuse(std::string_view text) {
  constexpr std::size_t kMostShown = 100;
  throw InputError(
      "set: expected NAME=top:AXIS,MM, NAME=bottom:AXIS,MM, NAME=box:X0,Y0,Z0,X1,Y1,Z1, "
      "NAME=normal:X,Y,Z,DEGREES or NAME=between:LABEL,LABEL, found '" +
      std::string(text.substr(0, kMostShown)) + "'");
}

bool is_name(std::string_view name) {
  constexpr std::size_t kMost = 60;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto may_follow = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() <= kMost && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), may_follow);
}

std::optional<double> number(std::string_view text) {
  if (text.ends_with("mm")) text.remove_suffix(2);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> result;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(',', begin);
    result.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return result;
    begin = end + 1;
  }
}

/// All words as numbers; empty if one is none, or their number is another.
std::vector<double> numbers(const std::vector<std::string_view>& texts, std::size_t count) {
  std::vector<double> values;
  for (const std::string_view text : texts) {
    const auto value = number(text);
    if (!value) return {};
    values.push_back(*value);
  }
  return values.size() == count ? values : std::vector<double>{};
}

bool read_end(const std::vector<std::string_view>& texts, FaceQuery& query) {
  if (texts.size() != 2 || texts[0].size() != 1) return false;
  const std::size_t axis = std::string_view("xyz").find(texts[0][0]);
  const auto depth = number(texts[1]);
  if (axis == std::string_view::npos || !depth || !(*depth > 0)) return false;
  query.axis = static_cast<int>(axis);
  query.depth = *depth;
  return true;
}

bool read_box(const std::vector<std::string_view>& texts, FaceQuery& query) {
  const auto v = numbers(texts, 6);
  if (v.empty() || !(v[0] < v[3] && v[1] < v[4] && v[2] < v[5])) return false;
  query.box = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  return true;
}

bool read_normal(const std::vector<std::string_view>& texts, FaceQuery& query) {
  const auto v = numbers(texts, 4);
  if (v.empty() || !(v[3] > 0 && v[3] <= 180)) return false;
  query.normal = unit_or_zero({v[0], v[1], v[2]});
  query.angle_deg = v[3];
  return norm(query.normal) > 0;
}

bool read_between(const std::vector<std::string_view>& texts, FaceQuery& query) {
  const auto v = numbers(texts, 2);
  const auto is_object = [](double x) { return x >= 1 && x <= 255 && x == std::floor(x); };
  if (v.empty() || !is_object(v[0]) || !is_object(v[1]) || v[0] == v[1]) return false;
  query.objects = {static_cast<Material>(v[0]), static_cast<Material>(v[1])};
  return true;
}

bool read_kind(std::string_view kind, const std::vector<std::string_view>& rest, FaceQuery& query) {
  if (kind == "top" || kind == "bottom") {
    query.kind = kind == "top" ? Kind::kTop : Kind::kBottom;
    return read_end(rest, query);
  }
  if (kind == "box") {
    query.kind = Kind::kBox;
    return read_box(rest, query);
  }
  if (kind == "normal") {
    query.kind = Kind::kNormal;
    return read_normal(rest, query);
  }
  query.kind = Kind::kBetween;
  return kind == "between" && read_between(rest, query);
}

/// Whether faces belong to a query.
class Judge {
 public:
  Judge(const BodyMesh& body, const FaceQuery& query)
      : mesh_(body.mesh), query_(query), box_(bounding_box(body.mesh.points)) {}

  bool holds(const std::array<Vec3, 3>& face) const {
    const Vec3 normal = unit_or_zero(cross(face[1] - face[0], face[2] - face[0]));
    switch (query_.kind) {
      case Kind::kTop:
        return is_at_end(face, normal, 1);
      case Kind::kBottom:
        return is_at_end(face, normal, -1);
      case Kind::kBox:
        return std::ranges::all_of(face, [&](const Vec3& p) { return query_.box.contains(p); });
      case Kind::kNormal:
        return dot(normal, query_.normal) >= std::cos(query_.angle_deg / kDegrees);
      case Kind::kBetween:
        return true;
    }
    return false;
  }

  std::array<Vec3, 3> corners(std::size_t cell, std::size_t face) const {
    const auto& k = kCellFaces[face];
    auto at = [&](int i) { return mesh_.points[mesh_.cells[cell][static_cast<std::size_t>(i)]]; };
    return {at(k[0]), at(k[1]), at(k[2])};
  }

 private:
  static constexpr double kDegrees = 180 / std::numbers::pi;

  bool is_at_end(const std::array<Vec3, 3>& face, const Vec3& normal, int side) const {
    constexpr double kLooksThere = 0.5;  // cosine
    const int axis = query_.axis;
    const double end = side > 0 ? box_.hi[axis] : box_.lo[axis];
    return side * normal[axis] > kLooksThere && std::ranges::all_of(face, [&](const Vec3& p) {
             return std::abs(end - p[axis]) <= query_.depth;
           });
  }

  const TetMesh& mesh_;
  const FaceQuery& query_;
  Box box_;
};

}  // namespace

FaceQuery parse_face_query(std::string_view text) {
  const std::size_t equals = text.find('='), colon = text.find(':');
  if (equals == std::string_view::npos || colon == std::string_view::npos || colon < equals) {
    refuse(text);
  }
  FaceQuery query;
  query.name = std::string(text.substr(0, equals));
  const std::string_view kind = text.substr(equals + 1, colon - equals - 1);
  if (!is_name(query.name) || !read_kind(kind, words(text.substr(colon + 1)), query)) refuse(text);
  return query;
}

std::vector<CellFace> find_faces(const BodyMesh& body, const FaceQuery& query) {
  const auto neighbors = cell_neighbors(body.mesh);
  const Judge judge(body, query);
  const bool between = query.kind == Kind::kBetween;
  std::vector<CellFace> faces;
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    if (between && body.materials[c] != query.objects[0]) continue;
    for (std::size_t f = 0; f < 4; ++f) {
      const Index n = neighbors[c][f];
      const bool candidate =
          between ? n != kNoIndex && body.materials[n] == query.objects[1] : n == kNoIndex;
      if (!candidate || !judge.holds(judge.corners(c, f))) continue;
      faces.push_back({static_cast<Index>(c), static_cast<Index>(f)});
    }
  }
  if (faces.empty()) {
    throw InputError("set '" + query.name +
                     "': expected at least one face of the body, found none");
  }
  return faces;
}

}  // namespace mesamis
