// SPDX-License-Identifier: MIT
#include "render/level_of_detail.h"

#include <cmath>

#include "mesh/simplified.h"

namespace sigs {

namespace {

Keep keep_of(const Run& run) {
  if (run.surface != Surface::solid) return Keep::all;
  return run.texture == kNoTexture ? Keep::place : Keep::texture;
}

}  // namespace

DrawList simplified_list(const std::vector<Vertex>& vertices, const DrawList& whole, int step) {
  std::vector<Keep> keep;
  for (const Run& run : whole.runs) keep.insert(keep.end(), run.count / 3, keep_of(run));
  Simplified simple = simplified(vertices, whole.indices, keep, std::ldexp(1.0, step));
  DrawList list{.indices = std::move(simple.indices), .runs = {}};
  std::size_t next = 0;  // of the triangles left, the first that belongs to no run yet
  for (const Run& run : whole.runs) {
    Run shorter = run;
    shorter.first = static_cast<std::uint32_t>(3 * next);
    while (next < simple.originals.size() && 3 * simple.originals[next] < run.first + run.count) ++next;
    shorter.count = static_cast<std::uint32_t>(3 * next) - shorter.first;
    if (shorter.count > 0) list.runs.push_back(shorter);
  }
  return list;
}

std::optional<int> step_for(double error_m) {
  if (!(error_m > 0) || !std::isfinite(error_m)) return std::nullopt;
  return static_cast<int>(std::floor(std::log2(error_m)));
}

}  // namespace sigs
