// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// Basic values: indices, vectors and tensors.
namespace mesamis {

/// Index of a point, cell, triangle or voxel line. Counts and products are kept in 64 bits.
using Index = std::int32_t;
inline constexpr Index kNoIndex = -1;

/// A point or a direction in space; lengths in mm unless the name says otherwise.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
/// The dot product, in the product of the two units: any unit.
inline double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// The cross product, in the product of the two units: any unit.
inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The Euclidean norm, in the unit of the vector.
inline double norm(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }

/// A symmetric 3x3 matrix: metrics (1/mm^2), gradient covariances.
struct Sym3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  friend bool operator==(const Sym3&, const Sym3&) = default;
};

inline constexpr Sym3 kIdentity3{1, 0, 0, 1, 0, 1};

inline Sym3 operator+(const Sym3& a, const Sym3& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
inline Sym3 operator-(const Sym3& a, const Sym3& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}
inline Sym3 operator*(double s, const Sym3& a) {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
}
inline Sym3& operator+=(Sym3& a, const Sym3& b) { return a = a + b; }
inline Vec3 operator*(const Sym3& a, const Vec3& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// The vector of length 1 in the direction of v (no unit); zero where v is.
inline Vec3 unit_or_zero(const Vec3& v) noexcept {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{};
}
/// A direction across another one, both of unit length; 0 for 0.
inline Vec3 perpendicular_to(const Vec3& n) noexcept {
  return unit_or_zero(cross(n, std::abs(n.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
}

/// The outer product v v^T, in the square of the unit of v.
inline Sym3 outer(const Vec3& v) noexcept {
  return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}
/// The quadratic form v^T a v, in the unit of a times the square of the unit of v.
inline double quadratic_form(const Sym3& a, const Vec3& v) noexcept {
  return v.x * (a.xx * v.x + 2 * (a.xy * v.y + a.xz * v.z)) + v.y * (a.yy * v.y + 2 * a.yz * v.z) +
         a.zz * v.z * v.z;
}
/// The sum of the diagonal, in the unit of the matrix.
inline double trace(const Sym3& a) noexcept { return a.xx + a.yy + a.zz; }
/// The determinant, in the cube of the unit of the matrix.
inline double determinant(const Sym3& a) noexcept {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}

/// A general 3x3 matrix by rows: direction cosines of a volume.
struct Mat3 {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  friend bool operator==(const Mat3&, const Mat3&) = default;
};
inline Vec3 operator*(const Mat3& a, const Vec3& v) {
  return {dot(a.rows[0], v), dot(a.rows[1], v), dot(a.rows[2], v)};
}
/// The transposed matrix.
inline Mat3 transpose(const Mat3& a) noexcept {
  const auto& r = a.rows;
  return {
      {Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y}, Vec3{r[0].z, r[1].z, r[2].z}}};
}
/// The determinant, in the cube of the unit of the matrix: no unit for direction cosines.
inline double determinant(const Mat3& a) noexcept {
  return dot(a.rows[0], cross(a.rows[1], a.rows[2]));
}

/// An axis-aligned box, lo < hi in every direction.
struct Box {
  Vec3 lo, hi;
  /// The side lengths, in the unit of the corners.
  Vec3 extent() const noexcept { return hi - lo; }
  /// The volume, in the cube of the unit of the corners.
  double volume() const noexcept {
    const Vec3 e = extent();
    return e.x * e.y * e.z;
  }
  /// Whether the point lies in the box, faces included; false for coordinates that are not numbers.
  /// @param p  in the unit of the corners.
  bool contains(const Vec3& p) const noexcept {
    return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// The frame in which coordinates of a patient are given. LPS (DICOM, ITK): x to the left, y to the
/// back, z to the head. RAS (NIfTI, 3D Slicer): x to the right, y to the front, z to the head.
enum class Frame { kLps, kRas };

/// @return  "LPS" or "RAS".
constexpr const char* frame_name(Frame frame) { return frame == Frame::kRas ? "RAS" : "LPS"; }

/// Converts a point or a direction from LPS to a frame, or from that frame to LPS: half a turn
/// about z for RAS, nothing for LPS.
/// @param p  of any unit.
/// @return in the same unit.
inline Vec3 in_frame(const Vec3& p, Frame frame) noexcept {
  return frame == Frame::kRas ? Vec3{-p.x, -p.y, p.z} : p;
}

/// The place i, j, k of an item of a grid; i runs fastest. O(1), two divisions.
/// @param size  items along each axis, at least 1; their number fits into the type of n.
/// @param n     of the item, an integer of any type, >= 0.
template <class Number>
std::array<Index, 3> grid_place(const std::array<Index, 3>& size, Number n) noexcept {
  const auto nx = static_cast<Number>(size[0]), ny = static_cast<Number>(size[1]);
  const Number line = n / nx;
  return {static_cast<Index>(n % nx), static_cast<Index>(line % ny), static_cast<Index>(line / ny)};
}

}  // namespace mesamis
