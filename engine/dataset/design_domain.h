// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "dataset/sample.h"

namespace sigs {

// The operational design domain (ODD): the conditions under which a system is to work, each with bins that a dataset
// should cover. docs/design-domain.md describes the file.

// Conditions that are numbers, one value for each intruder in each frame. Their names are kDomainNumberNames.
enum class DomainNumber {
  range_m,            // from the camera to the intruder's reference point
  size_px,            // longer side of the box of its whole silhouette
  bearing_deg,        // of the reference point, to the right of the optical axis, in the camera's axes: -180 to 180
  elevation_deg,      // likewise, above the plane of the camera's axes X and Y: -90 to 90
  aspect_deg,         // at the intruder, between its nose and the line to the camera: 0 head-on, 180 tail
  closing_speed_mps,  // how fast the range falls; negative where it grows
  camera_roll_deg,    // attitude of the camera in the world
  camera_pitch_deg,
  camera_yaw_deg,
};
inline constexpr std::array kDomainNumberNames{"range_m",         "size_px",          "bearing_deg",
                                               "elevation_deg",   "aspect_deg",       "closing_speed_mps",
                                               "camera_roll_deg", "camera_pitch_deg", "camera_yaw_deg"};

// The number of that name; none: the condition is a word.
[[nodiscard]] std::optional<DomainNumber> domain_number_named(std::string_view name);

// Words with a meaning of their own; every other name is that of a tag of the videos.
inline constexpr const char* kHorizonCondition = "horizon";  // above, on, below
inline constexpr const char* kKindCondition = "kind";        // category of the aircraft

// One condition with its bins: ranges of a number, or words.
struct DomainCondition {
  std::string name;
  std::vector<double> edges;        // of a number, rising: bin i is from edge i (included) to edge i + 1, which the
                                    // last bin includes too
  std::vector<std::string> values;  // of a word: one bin each

  [[nodiscard]] std::size_t bins() const { return edges.empty() ? values.size() : edges.size() - 1; }
  [[nodiscard]] std::string bin_name(std::size_t bin) const;  // "100 to 300", "above"
  [[nodiscard]] Span span_of_bin(std::size_t bin) const { return {edges.at(bin), edges.at(bin + 1)}; }

  // The bin of a value; none: it lies outside of the domain.
  [[nodiscard]] std::optional<std::size_t> bin_of(double value) const;
  [[nodiscard]] std::optional<std::size_t> bin_of(std::string_view value) const;
};

// A part of the domain: limits of numbers that hold together.
struct DomainZone {
  std::string name;
  std::vector<std::pair<std::string, Span>> limits;  // by condition, both ends included

  [[nodiscard]] const Span* limits_of(std::string_view condition) const;  // null: any value is allowed
};

struct DesignDomain {
  std::string name;
  int min_encounters = 1;  // in fewer, a bin or a pair of bins counts as empty
  std::vector<DomainCondition> conditions;
  std::vector<DomainZone> zones;  // empty: all of the conditions' bins, in every combination

  // Whether the domain has a bin, or two bins of different conditions together: some zone has more than an edge of
  // them.
  [[nodiscard]] bool has(std::size_t condition, std::size_t bin) const;
  [[nodiscard]] bool has(std::size_t condition, std::size_t bin, std::size_t other, std::size_t other_bin) const;
};

struct ReadDomain {
  DesignDomain domain;
  std::vector<Warning> warnings;  // unknown keys; what of LARD's table has no counterpart here
};

// Reads a domain: JSON, or the table of the LARD v2 generator (data/Lard_v2_Default_ODD.yaml in
// github.com/deel-ai/LARD: zones of indented "KEY: NUMBER" lines), which is recognised by its content. Errors name file
// and key: cannot_read where the file cannot be read, else bad_data.
[[nodiscard]] Result<ReadDomain> read_design_domain(const std::filesystem::path& path);

// The same from text; path is the file's name in messages.
[[nodiscard]] Result<ReadDomain> parse_design_domain(const std::string& text, const std::filesystem::path& path);

}  // namespace sigs
