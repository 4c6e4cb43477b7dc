// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "realism/clips.h"
#include "realism/samples.h"

namespace sigs::bench {

// Every measure of every target: measures.csv.
void write_measures(const std::vector<Sample>& samples, const std::filesystem::path& file);

// Which kinds a classifier tells from the real ones, by group of measures and by clips: auc.csv and auc.md. Returns for
// each kind the samples by how surely the forest with all measures tells them, the surest first.
using ByCertainty = std::vector<const Sample*>;
[[nodiscard]] std::vector<ByCertainty> write_aucs(const std::vector<Sample>& samples,
                                                  const std::vector<std::string>& kinds,
                                                  const std::filesystem::path& folder);

// Medians of all measures by kind, over the held-out and over the tuning clips: medians.md.
void write_medians(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                   const std::filesystem::path& file);

// A sheet of enlarged targets as PNG: one row for each sample, one column for each kind, named above.
void draw_sheet(const std::vector<const Sample*>& samples, const std::vector<std::string>& kinds,
                const std::filesystem::path& file);

// For each measure the distributions over the real targets and over each other kind, as PNG.
void draw_histograms(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                     const std::filesystem::path& file);

// The target of a kind; null: the sample has none.
[[nodiscard]] const Target* target_of(const Sample& sample, const std::string& kind);

// How bright an intruder is beside a real target of the same frame (mean contrast to the background), with the last of
// the settings and with the exposure that lit_like() (engine/comparison) finds by that target, in four views that
// lit_like() does not draw. Prints a table in Markdown: held-out clips, tuning clips.
void compare_lit(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs);

// How OpenCV's trackers follow each clip's real target and an inserted one that flies beside it: as large, along the
// same path, over the same 61 frames in the middle of the clip. Their boxes are compared with the published ones, and
// with the truth's. Writes trackers.csv (tracker, clip, kind, area under the success curve) and trackers.md: for each
// tracker and way to insert the mean difference between inserted and real, with an interval by bootstrap over clips.
void compare_trackers(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs,
                      const std::filesystem::path& folder);

}  // namespace sigs::bench
