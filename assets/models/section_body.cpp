// SPDX-License-Identifier: MIT
#include "section_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigs::models {

namespace {

constexpr double kPi = std::numbers::pi;

Patch both_sides(const Patch& left) {
  return joined(left, mirrored(left, true));
}

std::vector<Ring> with_poles(std::vector<Ring> rings) {
  const auto pole = [](const Ring& ring) { return Ring(ring.size(), 0.5 * (ring.front() + ring.back())); };
  rings.insert(rings.begin(), pole(rings.front()));
  rings.push_back(pole(rings.back()));
  return rings;
}

}  // namespace

Ring half_ring(const Section& section, double nose_x_m, double inset) {
  const double middle = 0.5 * (section.top + section.bottom), half_height = 0.5 * (section.top - section.bottom);
  const auto angle_of = [&](double z) {
    const double height = std::clamp((z - middle) / half_height, -1.0, 1.0);
    return std::acos(std::copysign(std::pow(std::abs(height), section.power / 2), height));
  };
  const double head = angle_of(section.head), sill = angle_of(section.sill);
  Ring ring;
  for (int i = 0; i <= kKeel; ++i) {
    double angle = head * i / kHead;
    if (i > kHead) angle = head + (sill - head) * (i - kHead) / (kSill - kHead);
    if (i > kSill) angle = sill + (kPi - sill) * (i - kSill) / (kKeel - kSill);
    const double c = std::cos(angle), power = 2 / section.power;
    const double z = middle + inset * half_height * std::copysign(std::pow(std::abs(c), power), c);
    const double y = inset * section.half_width * std::pow(std::abs(std::sin(angle)), power);
    ring.emplace_back(nose_x_m - section.s, i == 0 || i == kKeel ? 0.0 : y, z);
  }
  return ring;
}

Patch hull(const std::vector<Section>& sections, double nose_x_m, const MaterialOf& material_of) {
  std::vector<Ring> rings;
  for (const Section& section : sections) rings.push_back(half_ring(section, nose_x_m, 1.0));
  const Patch left = turned_outwards(skin(with_poles(std::move(rings)), untextured, material_of));
  return joined(left, mirrored(left, false));
}

Patch section_body(const std::vector<Section>& sections, const Covering& covering) {
  std::vector<Ring> rings;
  for (const Section& section : sections) rings.push_back(half_ring(section, covering.sides.nose_x_m, 1.0));
  rings = with_poles(std::move(rings));
  const int last = static_cast<int>(sections.size()) - 1;
  const auto material = [&](int r, int c) {
    const bool is_between = r > 0 && r <= last;
    const bool is_glass = is_between && covering.is_glass(0.5 * (sections[r - 1].s + sections[r].s), c);
    return std::string(is_glass ? "glass" : "fuselage");
  };
  const Patch sides = skin(
      strip_of(rings, 0, kUnderside), [&](const glm::dvec3& p, int, int) { return covering.sides.uv(p); }, material);
  const Patch below = skin(
      strip_of(rings, kUnderside, kKeel), [&](const glm::dvec3& p, int, int) { return covering.underside.uv(p); },
      "underside");
  return both_sides(turned_outwards(joined(sides, below)));
}

Patch section_lining(const std::vector<Section>& sections, const Covering& covering, double from_s, double to_s) {
  std::vector<Section> within;
  for (const Section& section : sections)
    if (section.s > from_s && section.s < to_s) within.push_back(section);
  std::vector<Ring> rings;
  for (const Section& section : within) rings.push_back(half_ring(section, covering.sides.nose_x_m, 0.95));
  const int count = static_cast<int>(within.size());
  Patch left = turned_outwards(skin(with_poles(std::move(rings)), untextured, [&](int r, int c) {
    const bool is_open = r > 0 && r < count && covering.is_glass(0.5 * (within[r - 1].s + within[r].s), c);
    return std::string(is_open ? "" : "interior");
  }));
  std::erase_if(left.faces, [](const Face& face) { return face.material.empty(); });
  return turned_over(both_sides(left));
}

}  // namespace sigs::models
