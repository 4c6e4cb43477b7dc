// SPDX-License-Identifier: MIT
#include "mesh/simplified.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/disjoint_sets.h"
#include "mesh/surface_deviation.h"

namespace sigs {
namespace {

constexpr double kMaxSine = 0.1;          // between a normal and that of the surface where it went
constexpr double kMinCosine = 0.3;        // between a triangle and what it becomes: none folds over
constexpr std::size_t kMaxAround = 24;    // triangles around a vertex: fans stay fans, and the work stays small
constexpr std::size_t kMaxSamples = 400;  // in them

// By vertex, the number of its place: equal positions share one.
std::vector<std::uint32_t> places_of(std::span<const Vertex> vertices) {
  const auto key = [&](std::uint32_t v) {
    const glm::vec3& p = vertices[v].position_m;
    return std::array{p.x, p.y, p.z};
  };
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> places(vertices.size());
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && key(order[i]) != key(order[i - 1])) ++place;
    places[order[i]] = place;
  }
  return places;
}

// By vertex, a number of what hangs together by triangles that share vertices: to either side of a seam another one.
std::vector<std::uint32_t> sheets_of(std::size_t vertex_count, std::span<const std::uint32_t> indices) {
  DisjointSets disjoint_sets(vertex_count);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    disjoint_sets.join(indices[i], indices[i + 1]);
    disjoint_sets.join(indices[i], indices[i + 2]);
  }
  std::vector<std::uint32_t> sheets(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) sheets[v] = disjoint_sets.root(v);
  return sheets;
}

struct Sample {
  Vertex at;
  std::uint32_t sheet;
  bool is_textured;
};

struct Face {
  std::array<std::uint32_t, 3> vertices;
  std::vector<std::uint32_t> samples;  // that lie nearest to it
  Keep keep;
  bool is_there = true;
};

Vertex middle_of(const Vertex& a, const Vertex& b) {
  return {(a.position_m + b.position_m) / 2.0F, a.normal + b.normal, (a.uv + b.uv) / 2.0F};
}

class Collapser {
 public:
  Collapser(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices, std::span<const Keep> keep)
      : vertices_(vertices), places_(places_of(vertices)), sheets_(sheets_of(vertices.size(), indices)) {
    const std::uint32_t place_count = vertices.empty() ? 0 : *std::max_element(places_.begin(), places_.end()) + 1;
    around_.resize(place_count);
    is_fixed_.resize(place_count, 0);
    position_m_.resize(place_count);
    for (std::size_t v = 0; v < vertices.size(); ++v) position_m_[places_[v]] = vertices[v].position_m;
    for (std::size_t i = 0; i < indices.size(); ++i)
      sides_.emplace_back(indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]);
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      add({indices[i], indices[i + 1], indices[i + 2]}, keep[i / 3]);
  }

  // Takes out what can go at an error of at most that.
  void run(double error_m) {
    std::vector<char> is_to_try(around_.size(), 1);
    for (bool is_any = true; is_any;) {
      is_any = false;
      for (std::uint32_t place = 0; place < around_.size(); ++place) {
        if (std::exchange(is_to_try[place], 0) == 0) continue;
        const std::vector<std::uint32_t> ring = ring_of(place);
        if (ring.empty() || !takes_out(place, ring, error_m)) continue;
        for (const std::uint32_t neighbor : ring) is_to_try[neighbor] = 1;
        is_any = true;
      }
    }
  }

  [[nodiscard]] Simplified result() const {
    Simplified simple;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (!triangles_[i].is_there) continue;
      simple.indices.insert(simple.indices.end(), triangles_[i].vertices.begin(), triangles_[i].vertices.end());
      simple.originals.push_back(static_cast<std::uint32_t>(i));
    }
    return simple;
  }

 private:
  using Corner3 = std::array<std::uint32_t, 3>;

  // What a triangle around a place becomes, and what of a sample is nearest to which.
  struct Change {
    std::vector<std::pair<std::uint32_t, Corner3>> becomes;
    std::vector<std::uint32_t> goes;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moves;  // sample, triangle
    std::vector<Sample> gone;                                    // vertices; numbered on after all samples
  };

  void add(const Corner3& corners, Keep keep) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    Face triangle{corners, {}, keep};
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t place = places_[corners[i]];
      const std::uint32_t next = corners[(i + 1) % 3];
      if (place == places_[next] || keep == Keep::all) is_fixed_[place] = is_fixed_[places_[next]] = 1;
      if (around_[place].empty() || around_[place].back() != number) around_[place].push_back(number);
      if (keep == Keep::all || (corners[i] > next && has_side(next, corners[i]))) continue;  // it is the other's
      triangle.samples.push_back(static_cast<std::uint32_t>(samples_.size()));
      samples_.push_back({middle_of(vertices_[corners[i]], vertices_[next]), sheets_[next], keep == Keep::texture});
    }
    triangles_.push_back(std::move(triangle));
  }

  [[nodiscard]] bool has_side(std::uint32_t from, std::uint32_t to) const {
    return std::binary_search(sides_.begin(), sides_.end(), std::pair(from, to));
  }

  // The places around one, one after the other; none where they are no closed ring, or must stay.
  [[nodiscard]] std::vector<std::uint32_t> ring_of(std::uint32_t place) const {
    const std::vector<std::uint32_t>& around = around_[place];
    if (is_fixed_[place] != 0 || around.size() < 3 || around.size() > kMaxAround) return {};
    std::array<std::pair<std::uint32_t, std::uint32_t>, kMaxAround> edges;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Corner3& v = triangles_[around[i]].vertices;
      const int at = places_[v[0]] == place ? 0 : places_[v[1]] == place ? 1 : 2;
      edges[i] = {places_[v[(at + 1) % 3]], places_[v[(at + 2) % 3]]};
    }
    std::vector<std::uint32_t> ring{edges[0].first};
    for (std::uint32_t next = edges[0].second; next != edges[0].first;) {
      if (std::find(ring.begin(), ring.end(), next) != ring.end()) return {};
      ring.push_back(next);
      const auto onward = std::find_if(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(around.size()),
                                       [&](const auto& edge) { return edge.first == ring.back(); });
      if (onward == edges.begin() + static_cast<std::ptrdiff_t>(around.size())) return {};
      next = onward->second;
    }
    if (ring.size() != around.size()) return {};
    return ring;
  }

  bool takes_out(std::uint32_t place, const std::vector<std::uint32_t>& ring, double error_m) {
    std::vector<std::uint32_t> nearest_first = ring;
    std::stable_sort(nearest_first.begin(), nearest_first.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance_m(a, place) < distance_m(b, place); });
    Change change;
    for (const std::uint32_t to : nearest_first) {
      if (!is_link(ring, to) || !finds_triangles(place, to, change) || !finds_samples(place, error_m, change)) continue;
      apply(place, to, ring, change);
      return true;
    }
    return false;
  }

  [[nodiscard]] double distance_m(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(position_m_[a], position_m_[b]);
  }

  // Two places of the ring, and no more, neighbour on the one: else surfaces would come to lie on each other (Dey,
  // Edelsbrunner, Guha and Nekhayev 1999).
  [[nodiscard]] bool is_link(const std::vector<std::uint32_t>& ring, std::uint32_t to) const {
    std::vector<std::uint32_t> common;
    for (const std::uint32_t number : around_[to])
      for (const std::uint32_t v : triangles_[number].vertices) {
        const std::uint32_t other = places_[v];
        if (other != to && std::find(ring.begin(), ring.end(), other) != ring.end()) common.push_back(other);
      }
    std::sort(common.begin(), common.end());
    return std::unique(common.begin(), common.end()) - common.begin() == 2;
  }

  [[nodiscard]] glm::dvec3 across(const Corner3& v) const {
    const glm::dvec3 a(vertices_[v[0]].position_m);
    return glm::cross(glm::dvec3(vertices_[v[1]].position_m) - a, glm::dvec3(vertices_[v[2]].position_m) - a);
  }

  // Each vertex at the place becomes that at the other on its side of any seam.
  bool finds_triangles(std::uint32_t place, std::uint32_t to, Change& change) const {
    change.becomes.clear();
    change.goes.clear();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moved;  // vertex, what it becomes
    for (const std::uint32_t number : around_[place]) {
      std::uint32_t from = 0;
      std::uint32_t target = 0;
      bool has_target = false;
      for (const std::uint32_t v : triangles_[number].vertices) {
        if (places_[v] == place) from = v;
        if (places_[v] != to) continue;
        target = v;
        has_target = true;
      }
      if (!has_target) continue;
      change.goes.push_back(number);
      for (const auto& [known, becomes] : moved)
        if (known == from && becomes != target) return false;
      moved.emplace_back(from, target);
    }
    for (const std::uint32_t number : around_[place]) {
      if (std::find(change.goes.begin(), change.goes.end(), number) != change.goes.end()) continue;
      Corner3 v = triangles_[number].vertices;
      const glm::dvec3 before = across(v);
      for (std::uint32_t& corner : v) {
        if (places_[corner] != place) continue;
        const auto known =
            std::find_if(moved.begin(), moved.end(), [&](const auto& pair) { return pair.first == corner; });
        if (known == moved.end()) return false;
        corner = known->second;
      }
      const glm::dvec3 after = across(v);
      if (!(glm::dot(before, after) > kMinCosine * glm::length(before) * glm::length(after))) return false;
      change.becomes.emplace_back(number, v);
    }
    return true;
  }

  // The nearest of what the triangles become, within error_m, for every sample that lay on them.
  bool finds_samples(std::uint32_t place, double error_m, Change& change) const {
    change.moves.clear();
    change.gone.clear();
    const auto finds = [&](const Sample& sample, std::uint32_t number) {
      double min_m = error_m;
      const std::uint32_t* nearest = nullptr;
      for (const auto& [triangle, v] : change.becomes) {
        if (sheets_[v[0]] != sample.sheet) continue;
        const double off_m = offset_m(sample.at, {&vertices_[v[0]], &vertices_[v[1]], &vertices_[v[2]]},
                                      sample.is_textured, min_m, kMaxSine);
        if (!(off_m <= min_m)) continue;
        min_m = off_m;
        nearest = &triangle;
        if (off_m == 0) break;
      }
      if (nearest != nullptr) change.moves.emplace_back(number, *nearest);
      return nearest != nullptr;
    };
    const std::vector<std::uint32_t> wedges = wedges_at(place);
    auto number = static_cast<std::uint32_t>(samples_.size());
    for (const std::uint32_t v : wedges) {
      change.gone.push_back({vertices_[v], sheets_[v], is_textured(place, v)});
      if (!finds(change.gone.back(), number++)) return false;
    }
    for (const std::uint32_t triangle : around_[place])
      for (const std::uint32_t sample : triangles_[triangle].samples)
        if (!finds(samples_[sample], sample) || change.moves.size() > kMaxSamples) return false;
    return true;
  }

  [[nodiscard]] std::vector<std::uint32_t> wedges_at(std::uint32_t place) const {
    std::vector<std::uint32_t> wedges;
    for (const std::uint32_t number : around_[place])
      for (const std::uint32_t v : triangles_[number].vertices)
        if (places_[v] == place && std::find(wedges.begin(), wedges.end(), v) == wedges.end()) wedges.push_back(v);
    return wedges;
  }

  [[nodiscard]] bool is_textured(std::uint32_t place, std::uint32_t vertex) const {
    const std::vector<std::uint32_t>& around = around_[place];
    return std::any_of(around.begin(), around.end(), [&](std::uint32_t number) {
      const Face& triangle = triangles_[number];
      return triangle.keep == Keep::texture &&
             std::find(triangle.vertices.begin(), triangle.vertices.end(), vertex) != triangle.vertices.end();
    });
  }

  void apply(std::uint32_t place, std::uint32_t to, const std::vector<std::uint32_t>& ring, const Change& change) {
    samples_.insert(samples_.end(), change.gone.begin(), change.gone.end());
    for (const std::uint32_t number : around_[place]) triangles_[number].samples.clear();
    for (const auto& [number, v] : change.becomes) {
      triangles_[number].vertices = v;
      around_[to].push_back(number);
    }
    for (const std::uint32_t number : change.goes) triangles_[number].is_there = false;
    for (const auto& [sample, number] : change.moves) triangles_[number].samples.push_back(sample);
    around_[place].clear();
    for (const std::uint32_t neighbor : ring)
      std::erase_if(around_[neighbor], [&](std::uint32_t number) { return !triangles_[number].is_there; });
  }

  std::span<const Vertex> vertices_;
  std::vector<std::uint32_t> places_;
  std::vector<std::uint32_t> sheets_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides_;  // of all triangles there were, from vertex to vertex
  std::vector<Face> triangles_;
  std::vector<Sample> samples_;
  std::vector<std::vector<std::uint32_t>> around_;  // by place, its triangles
  std::vector<char> is_fixed_;
  std::vector<glm::vec3> position_m_;
};

}  // namespace

Simplified simplified(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                      std::span<const Keep> keep, double error_m) {
  Collapser collapser(vertices, indices, keep);
  if (error_m > 0)
    for (const double share : {1.0 / 16, 1.0 / 4, 1.0}) collapser.run(share * error_m);
  return collapser.result();
}

}  // namespace sigs
