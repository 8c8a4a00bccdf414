// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/split_edges.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::surface {
namespace {

constexpr Index kWhole = -1;  // an edge that is not split

/// A triangle and the middles of its edges; edge i runs from corner i to the next.
struct SplitTriangle {
  Triangle corners;
  Triangle middles{kWhole, kWhole, kWhole};

  int count() const {
    return static_cast<int>(
        std::count_if(middles.begin(), middles.end(), [](Index n) { return n != kWhole; }));
  }
  void rotate() {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::rotate(middles.begin(), middles.begin() + 1, middles.end());
  }
};

/// The half edges that run along one edge.
using Edge = std::span<const HalfEdge>;

/// An edge and what the rule says of it.
enum class Answer : char { kUnknown, kNo, kYes };
struct AskedEdge {
  std::array<Index, 2> ends;
  Answer answer;
};

class Splitter {
 public:
  Splitter(TriMesh& surface, const SplitRule& rule, SplitOptions options)
      : surface_(surface),
        rule_(rule),
        least_height_(options.least_height),
        held_(std::move(options.held)) {}

  /// Splits every edge that the rule asks for. @return false if there was none.
  bool round() {
    held_.resize(surface_.points.size(), 0);
    std::vector<SplitTriangle> split = find_middles();
    if (split.empty()) return false;
    std::vector<Triangle> triangles;
    triangles.reserve(2 * split.size());
    for (SplitTriangle& t : split) cut(t, triangles);
    surface_.triangles = std::move(triangles);
    return true;
  }

 private:
  static constexpr int kNone = -1;

  double length(Index a, Index b) const { return norm(surface_.points[a] - surface_.points[b]); }
  bool stays(Index a, Index b) const {
    return (held_[a] != kFree && held_[b] != kFree) || held_[a] == kFixed || held_[b] == kFixed;
  }
  /// Of an edge that stays less than that of any other.
  double length_to_split(Index a, Index b) const { return stays(a, b) ? -1 : length(a, b); }

  /// The corner from which a triangle's longest edge runs, of those that may be split.
  int longest_edge(const Triangle& t) const {
    const std::array<double, 3> lengths{length_to_split(t[0], t[1]), length_to_split(t[1], t[2]),
                                        length_to_split(t[2], t[0])};
    return static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  }

  /// Finds what the rule says of each edge; most edges have been asked in the last round.
  void ask(const std::vector<Edge>& edges) {
    std::vector<AskedEdge> now(edges.size());
    std::size_t before = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::array<Index, 2> ends{edges[e][0].lo, edges[e][0].hi};
      while (before < answers_.size() && answers_[before].ends < ends) ++before;
      const bool known = before < answers_.size() && answers_[before].ends == ends;
      now[e] = {ends, known ? answers_[before].answer : Answer::kUnknown};
    }
    parallel_for(edges.size(), [&](std::size_t e) {
      auto& [ends, answer] = now[e];
      if (answer != Answer::kUnknown) return;
      const auto [a, b] = ends;
      const bool splits = !stays(a, b) && rule_(surface_.points[a], surface_.points[b]);
      answer = splits ? Answer::kYes : Answer::kNo;
    });
    answers_ = std::move(now);
  }

  /// Of each triangle the corner from which the edge to split runs, or none. That is the longest
  /// edge, whichever the rule asks for: others would make needles.
  std::vector<int> edges_to_split(const std::vector<Edge>& edges) {
    ask(edges);
    std::vector<int> corners(surface_.triangles.size(), kNone);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (answers_[e].answer == Answer::kNo) continue;
      for (const HalfEdge& h : edges[e]) {
        const auto t = static_cast<std::size_t>(h.triangle);
        corners[t] = longest_edge(surface_.triangles[t]);
      }
    }
    return corners;
  }

  bool may_be_split(Edge edge) const {
    return std::all_of(edge.begin(), edge.end(), [&](const HalfEdge& h) {
      const auto [a, b, c] = surface_.triangles[static_cast<std::size_t>(h.triangle)];
      return triangle_height(surface_.points[a], surface_.points[b], surface_.points[c]) >=
             least_height_;
    });
  }

  /// Adds the points and tells the triangles of them; empty if nothing is to be split.
  std::vector<SplitTriangle> find_middles() {
    const auto half_edges = sorted_half_edges(surface_.triangles, surface_.points.size());
    std::vector<Edge> edges;
    for_each_edge(half_edges, [&edges](Edge edge) { edges.push_back(edge); });
    const std::vector<int> corners = edges_to_split(edges);
    const std::size_t before = surface_.points.size();
    std::vector<SplitTriangle> split;
    for (const Triangle& t : surface_.triangles) split.push_back({t});
    for (const Edge edge : edges) {
      const bool asked = std::any_of(edge.begin(), edge.end(), [&](const HalfEdge& h) {
        return corners[static_cast<std::size_t>(h.triangle)] == h.corner;
      });
      if (!asked || !may_be_split(edge)) continue;
      const auto middle = static_cast<Index>(surface_.points.size());
      surface_.points.push_back(0.5 * (surface_.points[edge[0].lo] + surface_.points[edge[0].hi]));
      for (const HalfEdge& h : edge) {
        split[static_cast<std::size_t>(h.triangle)].middles[static_cast<std::size_t>(h.corner)] =
            middle;
      }
    }
    if (surface_.points.size() == before) split.clear();
    return split;
  }

  void cut(SplitTriangle& t, std::vector<Triangle>& out) const {
    const int count = t.count();
    const auto& [a, b, c] = t.corners;
    const auto& [ab, bc, ca] = t.middles;
    if (count == 0) {
      out.push_back(t.corners);
    } else if (count == 3) {
      out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    } else if (count == 1) {
      while (ab == kWhole) t.rotate();
      out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
    } else {
      while (ca != kWhole) t.rotate();
      out.push_back({ab, b, bc});
      if (length(a, bc) < length(ab, c)) {
        out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
      } else {
        out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
      }
    }
  }

  TriMesh& surface_;
  const SplitRule& rule_;
  double least_height_;
  std::vector<char> held_;
  std::vector<AskedEdge> answers_;  // of the last round, in the order of the edges
};

}  // namespace

TriMesh split_edges(TriMesh surface, const SplitRule& rule, SplitOptions options) {
  require_sound(surface);
  const int rounds = options.rounds;
  Splitter splitter(surface, rule, std::move(options));
  for (int n = 0; n < rounds && splitter.round(); ++n) {
  }
  return surface;
}

}  // namespace mesamis::detail::surface
