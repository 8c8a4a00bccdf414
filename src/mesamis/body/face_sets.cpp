// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/face_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/body_skin.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/surface/components.h"

namespace mesamis {
namespace {

using Kind = FaceQuery::Kind;

[[noreturn]] void refuse(std::string_view text) {
  throw InputError(
      "set: expected NAME=top:AXIS,MM, NAME=bottom:AXIS,MM, NAME=box:X0,Y0,Z0,X1,Y1,Z1, "
      "NAME=normal:X,Y,Z,DEGREES, NAME=between:OBJECT,OBJECT (numbers in their order, from 1), "
      "NAME=outer or NAME=inner, found " +
      quoted_text(text));
}

/// A length with or without its unit, mm; or another number.
std::optional<double> number(std::string_view text) {
  if (text.ends_with("mm")) text.remove_suffix(2);
  return written_number(text);
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

/// The kinds without a place.
bool read_side(std::string_view kind, FaceQuery& query) {
  query.kind = kind == "outer" ? Kind::kOuter : Kind::kInner;
  return kind == "outer" || kind == "inner";
}

/// Whether faces belong to a query of a place.
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
      case Kind::kOuter:
      case Kind::kInner:
        return true;  // chosen by their neighbours
    }
    return false;
  }

  std::array<Vec3, 3> corners(const CellFace& face) const {
    const auto& k = kCellFaces[static_cast<std::size_t>(face[1])];
    auto at = [&](int i) {
      return mesh_.points[mesh_.cells[face[0]][static_cast<std::size_t>(i)]];
    };
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

/// The faces of a body for which holds(cell, neighbour) is true, in the order of the cells.
template <class Holds>
std::vector<CellFace> faces_where(const BodyMesh& body, const Holds& holds) {
  const auto neighbors = cell_neighbors(body.mesh);
  std::vector<CellFace> faces;
  for (Index c = 0; c < std::ssize(neighbors); ++c) {
    for (Index f = 0; f < 4; ++f) {
      if (holds(c, neighbors[c][static_cast<std::size_t>(f)])) faces.push_back({c, f});
    }
  }
  return faces;
}

/// On the boundary, or between the objects of the query.
std::vector<CellFace> candidates(const BodyMesh& body, const FaceQuery& query) {
  if (query.kind != Kind::kBetween) {
    return faces_where(body, [](Index, Index n) { return n == kNoIndex; });
  }
  return faces_where(body, [&](Index c, Index n) {
    return n != kNoIndex && body.materials[c] == query.objects[0] &&
           body.materials[n] == query.objects[1];
  });
}

/// The faces of the boundary that are outer, or those that are not.
std::vector<CellFace> faces_on_side(const BodyMesh& body, bool outer) {
  const SurfaceComponents parts = find_components(body_skin(body));
  const std::vector<CellFace> boundary = candidates(body, {});
  std::vector<CellFace> faces;
  for (std::size_t i = 0; i < boundary.size(); ++i) {  // triangle i of the skin is face i
    if ((parts.sizes[parts.of_triangle[i]].volume > 0) == outer) faces.push_back(boundary[i]);
  }
  return faces;
}

std::vector<CellFace> faces_at_place(const BodyMesh& body, const FaceQuery& query) {
  std::vector<CellFace> faces = candidates(body, query);
  const Judge judge(body, query);
  std::erase_if(faces, [&](const CellFace& f) { return !judge.holds(judge.corners(f)); });
  return faces;
}

}  // namespace

FaceQuery parse_face_query(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) refuse(text);
  FaceQuery query;
  query.name = std::string(text.substr(0, equals));
  const std::string_view place = text.substr(equals + 1);
  const std::size_t colon = place.find(':');
  const bool is_read =
      colon == std::string_view::npos
          ? read_side(place, query)
          : read_kind(place.substr(0, colon), words(place.substr(colon + 1)), query);
  if (!is_solver_name(query.name) || !is_read) refuse(text);
  return query;
}

FaceQuery in_lps(FaceQuery query, Frame frame) {
  if (frame == Frame::kLps) return query;
  const auto turned = [](const Vec3& p) { return Vec3{-p.x, -p.y, p.z}; };
  const bool is_end = query.kind == Kind::kTop || query.kind == Kind::kBottom;
  if (is_end && query.axis != 2) query.kind = query.kind == Kind::kTop ? Kind::kBottom : Kind::kTop;
  const Box box = query.box;
  query.box = {{-box.hi.x, -box.hi.y, box.lo.z}, {-box.lo.x, -box.lo.y, box.hi.z}};
  query.normal = turned(query.normal);
  return query;
}

std::vector<CellFace> detail::body::find_faces(const BodyMesh& body, const FaceQuery& query) {
  const bool outer = query.kind == Kind::kOuter;
  const bool by_side = outer || query.kind == Kind::kInner;
  return by_side ? faces_on_side(body, outer) : faces_at_place(body, query);
}

}  // namespace mesamis
