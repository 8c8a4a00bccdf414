// SPDX-License-Identifier: Apache-2.0
// Bytes become a start mesh, a metric and options; what remesh() makes of them must keep its law.
// The entry point is libFuzzer's; driver.cpp calls it where there is no libFuzzer.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/remesh/remesh.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The input as numbers. It never ends: after the last byte come bytes mixed from those before.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t next() {
    const std::uint8_t byte = used_ < size_ ? data_[used_] : static_cast<std::uint8_t>(mix_ >> 40);
    ++used_;
    mix_ = (mix_ ^ byte) * 1099511628211u + used_;
    return byte;
  }
  int pick(int count) { return next() % count; }
  bool one_in(int count) { return pick(count) == count - 1; }
  double between(double lo, double hi) {
    const int high = next();
    return lo + (hi - lo) * (256 * high + next()) / 65535;
  }
  double magnitude(double lo, double hi) { return std::exp(between(std::log(lo), std::log(hi))); }

 private:
  const std::uint8_t* data_;
  std::size_t size_, used_ = 0;
  std::uint64_t mix_ = 14695981039346656037u;
};

Box decode_box(Bytes& bytes) {
  const double scale = bytes.one_in(4) ? bytes.magnitude(1e-6, 1e6) : 1;
  const bool is_cube = bytes.one_in(4);
  Box box;
  for (int axis = 0; axis < 3; ++axis)
    box.hi[axis] = scale * (is_cube ? 1 : bytes.magnitude(1, 1000));
  const Vec3 size = box.extent();
  const double longest = std::max({size.x, size.y, size.z});
  const double far = bytes.one_in(3) ? longest * bytes.magnitude(1, 1e8) : bytes.pick(2) * longest;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = bytes.between(-far, far);
    box.hi[axis] = box.lo[axis] + size[axis];
  }
  return box;
}

TetMesh decode_start(Bytes& bytes, const Box& box) {
  if (bytes.one_in(4)) return coarse_box_mesh(box);
  std::array<Index, 3> bricks{};
  for (Index& n : bricks) n = 1 + bytes.pick(5);
  if (bytes.one_in(8)) bricks[bytes.pick(3)] = 40;
  if (bytes.one_in(2)) return box_mesh(box, bricks);
  const double amount = bytes.between(0, 0.3);
  return perturbed_box(box, bricks, amount, bytes.next());
}

void spoil(Bytes& bytes, TetMesh& mesh) {
  const auto cell = static_cast<std::size_t>(bytes.next()) % mesh.cells.size();
  const auto point = static_cast<std::size_t>(bytes.next()) % mesh.points.size();
  switch (bytes.pick(5)) {
    case 0:
      mesh.cells.erase(mesh.cells.begin() + static_cast<std::ptrdiff_t>(cell));
      break;
    case 1:
      std::swap(mesh.cells[cell][0], mesh.cells[cell][1]);
      break;
    case 2:
      mesh.cells[cell][bytes.pick(4)] = bytes.one_in(2) ? kNoIndex : 1'000'000'000;
      break;
    case 3:
      mesh.points[point][bytes.pick(3)] = bytes.one_in(2) ? kNan : kInfinity;
      break;
    default:
      mesh.points[point] = mesh.points[0];
  }
}

/// A metric as logarithms of its three sizes and three angles that turn it.
using Tensor = std::array<double, 6>;

std::array<Vec3, 3> frame(double a, double b, double c) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b),
               cc = std::cos(c), sc = std::sin(c);
  return {Vec3{ca * cc - sa * cb * sc, sa * cc + ca * cb * sc, sb * sc},
          Vec3{-ca * sc - sa * cb * cc, -sa * sc + ca * cb * cc, sb * cc},
          Vec3{sa * sb, -ca * sb, cb}};
}

Sym3 log_metric(const Tensor& t) {
  return compose({-2 * t[0], -2 * t[1], -2 * t[2]}, frame(t[3], t[4], t[5]));
}

Sym3 metric_of(const Tensor& t) {
  return compose({std::exp(-2 * t[0]), std::exp(-2 * t[1]), std::exp(-2 * t[2])},
                 frame(t[3], t[4], t[5]));
}

Tensor blend(const Tensor& a, const Tensor& b, double t) {
  Tensor result{};
  for (std::size_t i = 0; i < 6; ++i) result[i] = (1 - t) * a[i] + t * b[i];
  return result;
}

/// Random tensors of a kind: how fine, how stretched, how turned.
class Tensors {
 public:
  Tensors(Bytes& bytes, const Box& box) : bytes_(bytes) {
    // A metric stretched by 1e7 has eigenvalues of 1e-14 of the others: all that double can tell.
    constexpr std::array<double, 5> kAspects{1, 10, 1000, 1e5, 1e7};
    constexpr std::array<double, 4> kJumps{1, 10, 100, 1000};
    constexpr std::array<std::array<double, 2>, 3> kSizes{{{1e-18, 1e-12}, {10, 1e60}, {0.01, 1}}};
    const auto& [finest, coarsest] = kSizes[std::min(2, bytes.pick(8))];
    const double edge = bytes.one_in(2) ? norm(box.extent()) : std::cbrt(box.volume());
    log_size_ = std::log(edge * bytes.magnitude(finest, coarsest));
    log_aspect_ = std::log(kAspects[bytes.pick(5)]);
    log_jump_ = std::log(kJumps[bytes.pick(4)]);
    is_turned_ = bytes.one_in(2);
  }

  Tensor next() {
    Tensor t{};
    const double log_size = log_size_ + bytes_.between(0, log_jump_);
    for (std::size_t i = 0; i < 3; ++i) t[i] = log_size + bytes_.between(0, log_aspect_);
    t[0] = log_size;
    t[1 + bytes_.pick(2)] = log_size + log_aspect_;
    for (std::size_t i = 3; i < 6; ++i) t[i] = is_turned_ ? bytes_.between(0, 6.3) : 0;
    return t;
  }

 private:
  Bytes& bytes_;
  double log_size_ = 0, log_aspect_ = 0, log_jump_ = 0;
  bool is_turned_ = false;
};

/// A tensor for each point: turning, jumping at a tilted plane, a layer, noise, or peaks.
std::vector<Tensor> decode_tensors(Bytes& bytes, const Box& box, const std::vector<Vec3>& points) {
  Tensors tensors(bytes, box);
  const int pattern = bytes.pick(5);
  const Tensor a = tensors.next(), b = tensors.next();
  const Vec3 normal{bytes.between(-1, 1), bytes.between(-1, 1), bytes.between(-1, 1)};
  const double offset = bytes.between(-0.3, 0.3);
  std::vector<Tensor> result;
  for (const Vec3& p : points) {
    double distance = -offset;
    for (int axis = 0; axis < 3; ++axis) {
      distance += normal[axis] * ((p[axis] - box.lo[axis]) / box.extent()[axis] - 0.5);
    }
    switch (pattern) {
      case 0:
        result.push_back(blend(a, b, std::clamp(0.5 + distance, 0.0, 1.0)));
        break;
      case 1:
        result.push_back(distance < 0 ? a : b);
        break;
      case 2:
        result.push_back(blend(a, b, std::min(1.0, 2 * std::abs(distance))));
        break;
      case 3:
        result.push_back(tensors.next());
        break;
      default:
        result.push_back(bytes.one_in(16) ? b : a);
    }
  }
  return result;
}

using Formula = std::function<Sym3(const Vec3&)>;

/// The metric of the block of a grid that holds the point: it jumps everywhere.
Formula blocks(const Box& box, const std::array<Index, 3>& size, std::vector<Sym3> metrics) {
  return [box, size, metrics = std::move(metrics)](const Vec3& p) {
    std::size_t block = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double t = (p[axis] - box.lo[axis]) / box.extent()[axis];
      const int n = size[axis];
      const auto i = static_cast<std::size_t>(std::clamp(static_cast<int>(n * t), 0, n - 1));
      block = block * static_cast<std::size_t>(n) + i;
    }
    return metrics[block];
  };
}

/// Sizes that grow from down to 1e-14 of the box at a plane, a line or a point.
Formula decode_layer(Bytes& bytes, const Box& box) {
  const double diagonal = norm(box.extent());
  const double finest = diagonal * bytes.magnitude(1e-14, 0.01);
  const double coarsest = diagonal * bytes.magnitude(0.01, 1);
  const double growth = bytes.magnitude(0.01, 1);
  const int codimension = 1 + bytes.pick(3);
  const double turn = bytes.one_in(2) ? bytes.between(0, 6.3) : 0;
  const std::array<Vec3, 3> axes = frame(turn, 2 * turn, 3 * turn);
  Vec3 center;
  for (int axis = 0; axis < 3; ++axis) {
    const double inside = bytes.between(box.lo[axis], box.hi[axis]);
    center[axis] = bytes.one_in(2) ? inside : box.lo[axis];
  }
  return [=](const Vec3& p) {
    double distance = 0;
    for (int i = 0; i < codimension; ++i) distance = std::hypot(distance, dot(axes[i], p - center));
    std::array<double, 3> values{};
    for (int i = 0; i < 3; ++i) {
      const double h = i < codimension ? std::min(coarsest, finest + growth * distance) : coarsest;
      values[i] = 1 / (h * h);
    }
    return compose(values, axes);
  };
}

/// A field and, if it has to be refused, the node that is to blame.
struct FieldCase {
  enum class Kind { kMesh, kGrid, kFormula } kind = Kind::kFormula;
  Box box;
  TetMesh background;
  std::array<Index, 3> size{};
  std::vector<Sym3> metrics;  ///< kGrid: their logarithms
  Formula formula;
  std::optional<std::size_t> bad_node;

  std::unique_ptr<MetricField> build() const {
    if (kind == Kind::kFormula) return std::make_unique<FormulaMetric>(formula);
    if (kind == Kind::kMesh) return std::make_unique<MeshMetricField>(background, metrics);
    std::vector<PackedSym3> logs;
    for (const Sym3& m : metrics) logs.push_back(pack(m));
    return std::make_unique<GridMetricField>(box, size, std::move(logs));
  }
};

/// No metric: of a mesh if it is not positive definite, of a grid if its logarithm is not finite.
Sym3 bad_metric(Bytes& bytes, FieldCase::Kind kind, const Sym3& m) {
  switch (bytes.pick(kind == FieldCase::Kind::kGrid ? 2 : 5)) {
    case 0:
      return {m.xx, m.xy, m.xz, kNan, m.yz, m.zz};
    case 1:
      return {m.xx, m.xy, m.xz, m.yy, m.yz, kInfinity};
    case 2:
      return {};
    case 3:
      return -1 * m;
    default:
      return {m.xx, 2 * std::sqrt(m.xx) * std::sqrt(m.yy), m.xz, m.yy, m.yz, m.zz};
  }
}

FieldCase decode_field(Bytes& bytes, const Box& box) {
  using Kind = FieldCase::Kind;
  FieldCase field;
  field.box = box;
  if (bytes.one_in(3)) {
    field.formula = decode_layer(bytes, box);
    return field;
  }
  // Most are formulas, which answer fastest.
  field.kind = std::array{Kind::kMesh, Kind::kGrid, Kind::kFormula}[std::min(2, bytes.pick(5))];
  for (Index& n : field.size) n = 2 + bytes.pick(6);
  const std::array<Index, 3> bricks{field.size[0] - 1, field.size[1] - 1, field.size[2] - 1};
  const double amount = field.kind == Kind::kMesh ? bytes.between(0, 0.2) : 0;
  field.background = perturbed_box(box, bricks, amount, bytes.next());
  for (const Tensor& t : decode_tensors(bytes, box, field.background.points)) {
    field.metrics.push_back(field.kind == Kind::kGrid ? log_metric(t) : metric_of(t));
  }
  const std::size_t node = bytes.next() % field.metrics.size();
  Sym3& m = field.metrics[node];
  if (field.kind == Kind::kGrid && bytes.one_in(8)) m = bytes.between(-1, 1) * Sym3{3e38, 1e20, 0};
  if (bytes.one_in(16)) {
    m = bad_metric(bytes, field.kind, m);
    // Formulas are not checked: remesh() must bear with what they answer.
    if (field.kind != Kind::kFormula) field.bad_node = node;
  }
  if (field.kind == Kind::kFormula) field.formula = blocks(box, field.size, field.metrics);
  return field;
}

RemeshOptions decode_options(Bytes& bytes) {
  RemeshOptions options;
  options.max_cells = 1 + 10 * bytes.next();
  if (bytes.one_in(4)) options.max_cells += 3000;
  if (bytes.one_in(2)) options.part_cells = 1000;
  if (!bytes.one_in(4)) options.max_rounds = bytes.pick(8);
  if (bytes.one_in(4)) options.polish_rounds = bytes.pick(4);
  return options;
}

void require(bool holds, const std::string& law) {
  if (holds) return;
  std::fprintf(stderr, "remesh_fuzz: error: %s\n", law.c_str());
  std::abort();
}

/// The field, or nothing if it was refused as it had to be.
std::unique_ptr<MetricField> build_field(const FieldCase& field) {
  try {
    auto built = field.build();
    require(!field.bad_node, "a field that is none was taken");
    return built;
  } catch (const InputError& error) {
    require(field.bad_node.has_value(), std::string("a field was refused: ") + error.what());
    const std::string named = "node " + std::to_string(*field.bad_node) + " ";
    require(std::string(error.what()).find(named) != std::string::npos,
            named + "is not named: " + error.what());
    return nullptr;
  }
}

void require_law(const TetMesh& start, const RemeshOptions& options, const TetMesh& mesh) {
  const Box box = bounding_box(start.points);
  const std::string flaw = find_flaw(mesh, box);
  require(flaw.empty(), "the mesh is not valid: " + flaw);
  require(bounding_box(mesh.points) == box, "the box has changed");
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                 corner & 4 ? box.hi.z : box.lo.z};
    require(std::find(mesh.points.begin(), mesh.points.end(), p) != mesh.points.end(),
            "a corner of the box is missing");
  }
  const auto most = std::max<std::int64_t>(std::ssize(start.cells), 3 * options.max_cells + 1000);
  require(std::ssize(mesh.cells) <= most, std::to_string(mesh.cells.size()) + " cells, at most " +
                                              std::to_string(most) + " expected");
}

void run_case(const TetMesh& start, const MetricField& metric, const RemeshOptions& options,
              bool twice) {
  const bool is_valid = find_flaw(start, bounding_box(start.points)).empty();
  try {
    const TetMesh mesh = with_threads(2, [&] { return remesh(start, metric, options); });
    require(is_valid, "a start mesh that is none was taken");
    require_law(start, options, mesh);
    if (!twice) return;
    with_threads(1, [&] {
      require(mesh_hash(mesh) == mesh_hash(remesh(start, metric, options)),
              "one and two threads give different meshes");
    });
  } catch (const InputError& error) {
    require(!is_valid, std::string("a valid start was refused: ") + error.what());
  } catch (const std::exception& error) {
    require(false, std::string("an exception that is no InputError: ") + error.what());
  }
}

}  // namespace
}  // namespace mesamis

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mesamis;
  Bytes bytes(data, size);
  const RemeshOptions options = decode_options(bytes);
  const bool twice = bytes.one_in(3);
  const bool spoilt = bytes.one_in(16);
  const Box box = decode_box(bytes);
  TetMesh start = decode_start(bytes, box);
  if (spoilt) spoil(bytes, start);
  const auto field = build_field(decode_field(bytes, box));
  if (field) run_case(start, *field, options, twice);
  return 0;
}
