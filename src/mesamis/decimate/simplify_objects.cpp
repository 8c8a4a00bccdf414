// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/simplify_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "mesamis/decimate/round_together.h"
#include "mesamis/decimate/simplify.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::decimate {
namespace {

using Place = std::array<double, 3>;

/// Joins objects to a partition whose material i is object i; outside of all is outside the box.
class Joining {
 public:
  void add(const TriMesh& object) {
    const std::vector<Index> numbers = numbers_of(object.points);
    for (const auto& [a, b, c] : object.triangles) add({numbers[a], numbers[b], numbers[c]});
    ++count_;
  }

  PartitionSurface taken() { return std::move(partition_); }

 private:
  /// Points of one object at one place stay apart, as those where it touches itself.
  std::vector<Index> numbers_of(const std::vector<Vec3>& points) {
    std::vector<Index> numbers;
    std::set<Index> own;
    for (const Vec3& p : points) {
      const auto next = static_cast<Index>(partition_.points.size());
      Index number = number_at_.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, next).first->second;
      if (!own.insert(number).second) number = next;
      if (number == next) partition_.points.push_back(p);
      numbers.push_back(number);
    }
    return numbers;
  }

  /// A triangle that an earlier object has, turned, is the boundary between both.
  void add(const Triangle& t) {
    const auto turned = shared_.find(lowest_first({t[0], t[2], t[1]}));
    if (turned != shared_.end() && partition_.sides[turned->second][1] == kNoIndex &&
        partition_.sides[turned->second][0] != count_) {
      partition_.sides[turned->second][1] = count_;
      return;
    }
    shared_.emplace(lowest_first(t), partition_.triangles.size());
    partition_.triangles.push_back(t);
    partition_.sides.push_back({count_, kNoIndex});
  }

  static Triangle lowest_first(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }

  PartitionSurface partition_;
  std::map<Place, Index> number_at_;
  std::map<Triangle, std::size_t> shared_;
  Index count_ = 0;  ///< of objects
};

}  // namespace

std::vector<TriMesh> simplify_objects(const std::vector<TriMesh>& objects,
                                      const DecimateOptions& options,
                                      std::vector<DecimateReport>* reports) {
  Joining joining;
  for (const TriMesh& object : objects) joining.add(object);
  PartitionSurface partition = joining.taken();
  const double shift = round_in_place(partition.points);
  DecimateOptions left = options;
  if (options.tolerance > 0) left.tolerance = std::max(0.0, options.tolerance - shift);
  DecimateReport proved;
  partition = simplify_partition(partition, left, &proved);
  std::vector<Index> materials(objects.size());
  std::iota(materials.begin(), materials.end(), 0);
  std::vector<TriMesh> results = object_surfaces(partition, materials);
  if (reports == nullptr) return results;
  reports->clear();
  const double bound = std::isfinite(left.tolerance)
                           ? shift + std::max(proved.original_to_result, proved.result_to_original)
                           : left.tolerance;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const double fine = fine_enough(objects[i], options.tolerance);
    reports->push_back({std::ssize(objects[i].triangles), std::ssize(results[i].triangles),
                        std::min(bound, max_distance(objects[i], results[i], fine)),
                        std::min(bound, max_distance(results[i], objects[i], fine))});
  }
  return results;
}

}  // namespace mesamis::detail::decimate
