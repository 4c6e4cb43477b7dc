// SPDX-License-Identifier: MIT
#include "evaluation/readers/results.h"

#include <array>
#include <cmath>

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

const FootageTruth kClip{.video = "clip", .size_px = {64, 48}, .first_frame = 1, .last_frame = 3};

void check_results(const Results& results) {
  for (const auto& [frame, boxes] : results.frames)
    for (const ReportedBox& reported : boxes) {
      ENSURE(frame >= kClip.first_frame && frame <= kClip.last_frame);
      ENSURE(std::isfinite(reported.box.x) && std::isfinite(reported.box.y) && std::isfinite(reported.score));
      ENSURE(reported.box.width > 0 && reported.box.height > 0);
    }
}

}  // namespace

void try_results(const FuzzInput& input) {
  const std::filesystem::path path = input.file("tracker.txt");
  const FramesOfImages images{.by_name = {{"1.png", 1}, {"2.png", 2}}, .by_id = {{1, 1}, {2, 2}}};
  using enum ResultsFormat;
  for (const ResultsFormat format : {automatic, otb, vot, mot, csv, aot, coco})
    for (const ResultsOptions& options : std::array{
             ResultsOptions{.format = format},
             ResultsOptions{.format = format, .multiple_per_frame = true, .start_frame = 2, .images = &images}}) {
      const Result<Results> results = read_results(path, kClip, options);
      if (results)
        check_results(*results);
      else
        check_message(results.error());
    }
}

}  // namespace sigs::fuzz
