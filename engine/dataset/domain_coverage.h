// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/design_domain.h"
#include "dataset/footage_cache.h"
#include "dataset/plan.h"
#include "truth/annotation.h"

namespace sigs {

// What of a design domain a dataset covers: predicted from a plan before a frame is made, or counted in the annotations
// of a dataset. An encounter is one intruder of one video that is in view in at least one frame; distractors do not
// count. A frame with two intruders in view counts for both.

// An intruder in one frame in which some of it can be seen.
struct DomainSight {
  std::array<double, kDomainNumberNames.size()> numbers{};  // by DomainNumber; NaN: not told
  HorizonSide horizon = HorizonSide::unknown;
};

struct DomainEncounter {
  std::map<std::string, std::string> words;  // the video's tags, and "kind"
  std::vector<DomainSight> sights;           // by time
};

struct DomainCount {
  long long frames = 0;
  long long encounters = 0;  // with at least one of these frames

  [[nodiscard]] bool operator==(const DomainCount&) const = default;
};

struct ConditionCoverage {
  std::vector<DomainCount> bins;
  DomainCount outside;  // the value is in no bin
  DomainCount untold;   // labels or plan do not tell the value
};

// Two conditions: what is in a bin of the first and in one of the second at the same time.
struct PairCoverage {
  std::size_t first = 0, second = 0;  // conditions of the domain
  std::vector<DomainCount> cells;     // by bin of the first, then of the second
};

// A bin of one condition, or one of each of two conditions.
struct DomainTarget {
  std::size_t condition = 0, bin = 0;
  std::optional<std::pair<std::size_t, std::size_t>> other = {};  // condition and bin

  [[nodiscard]] auto operator<=>(const DomainTarget&) const = default;
};

struct DomainCoverage {
  explicit DomainCoverage(DesignDomain of);

  void add(const DomainEncounter& encounter);

  // Calls f(target, count) for each pair of bins, of the domain or not.
  template <class Function>
  void for_each_pair(const Function& f) const {
    for (const PairCoverage& pair : pairs) {
      const std::size_t width = conditions[pair.second].bins.size();
      for (std::size_t cell = 0; cell < pair.cells.size(); ++cell)
        f(DomainTarget{pair.first, cell / width, std::pair{pair.second, cell % width}}, pair.cells[cell]);
    }
  }

  // Whether the domain has a bin, or a pair of bins.
  [[nodiscard]] bool has(const DomainTarget& target) const {
    return target.other ? domain.has(target.condition, target.bin, target.other->first, target.other->second)
                        : domain.has(target.condition, target.bin);
  }
  [[nodiscard]] bool is_empty(const DomainCount& count) const { return count.encounters < domain.min_encounters; }

  // Of the domain's pairs of bins those with min_encounters or more, and all.
  [[nodiscard]] std::pair<long long, long long> pairs_covered() const;

  // The domain's bins, or pairs of bins, with fewer than min_encounters, in the order of the conditions.
  [[nodiscard]] std::vector<DomainTarget> empty_bins() const;
  [[nodiscard]] std::vector<DomainTarget> empty_pairs() const;
  [[nodiscard]] std::string text_of(const DomainTarget& target) const;  // "range_m 100 to 300 with horizon above"

  DesignDomain domain;
  int videos = 0;
  int unopened = 0;          // further videos, of which a file cannot be opened
  long long frames = 0;      // of the videos, with and without intruders
  DomainCount in_view = {};  // all encounters
  DomainCount outside = {};  // a value in no bin, or told values that no zone has together
  std::vector<ConditionCoverage> conditions;
  std::vector<PairCoverage> pairs;  // of each two conditions, first < second
};

// The encounters of a planned video, all frames of it, without rendering (as predicted_coverage() of coverage.h). None
// where the files that its project names cannot be opened.
struct PlannedEncounters {
  int frames = 0;
  std::vector<DomainEncounter> encounters;
};
[[nodiscard]] std::optional<PlannedEncounters> encounters_of(const PlannedVideo& video, VideoVisibility& opener);

// Of planned videos. Error: interrupted.
[[nodiscard]] Result<DomainCoverage> predicted_domain_coverage(const DesignDomain& domain,
                                                               const std::vector<const PlannedVideo*>& videos,
                                                               const std::atomic<bool>* cancel = nullptr);

// Of a dataset that has been made, from its index and its annotations NAME/NAME.xml; intruders with a visible box
// count. The closing speed is that of the element `encounter` or, without it, of the distances in the neighbouring
// frames. Errors: cannot_read; bad_data that names the file; interrupted.
[[nodiscard]] Result<DomainCoverage> counted_domain_coverage(const DesignDomain& domain,
                                                             const std::filesystem::path& folder,
                                                             const std::atomic<bool>* cancel = nullptr);

// As tables for people, as JSON for programs, and as a plot (BGR, 8 bits): encounters by bin, and which pairs are
// empty.
//   title  "predicted", "counted from the labels"
[[nodiscard]] std::string domain_text(const DomainCoverage& coverage, const std::string& title);
[[nodiscard]] std::string domain_json(const DomainCoverage& coverage, const std::string& title);
[[nodiscard]] cv::Mat domain_plot(const DomainCoverage& coverage, const std::string& title);

}  // namespace sigs
