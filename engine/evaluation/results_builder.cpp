// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "evaluation/results_formats.h"

namespace sigs {

namespace {

constexpr double kMaxCoordinate_px = 1e9;  // beyond it areas lose their last pixels

Result<void> wrong_number(const ResultsFile& file, int line, const char* name, double number) {
  if (std::isnan(number))
    return file.wrong(line, std::string(name) +
                                " is NaN: leave out a frame without a box (mot, csv, aot, coco), or write nan "
                                "alone on its line (vot)");
  if (std::isinf(number)) return file.wrong(line, std::string(name) + " is infinite");
  return file.wrong(line, std::string(name) + " is beyond a billion pixels");
}

}  // namespace

tl::unexpected<Error> ResultsFile::wrong(int line, const std::string& what) const {
  return fail(path.string() + ": line " + std::to_string(line), what);
}

std::string frames_text(const FootageTruth& clip) {
  return "frames " + std::to_string(clip.first_frame) + " to " + std::to_string(clip.last_frame);
}

Result<void> ResultsBuilder::add(int frame, const ReportedBox& reported) {
  if (const Result<void> good = check_box(reported); !good) return good;
  if (const Result<void> good = check_place(frame, reported); !good) return good;
  results_.frames[frame].push_back(reported);
  return {};
}

std::string ResultsBuilder::frame_text(int frame) const {
  const std::string of_footage = std::to_string(frame);
  return first_number_ == file_.clip.first_frame
             ? of_footage
             : std::to_string(frame - file_.clip.first_frame + first_number_) + " (" + of_footage + " of the footage)";
}

Result<void> ResultsBuilder::check_box(const ReportedBox& reported) const {
  const Box& box = reported.box;
  const std::pair<const char*, double> numbers[] = {
      {"x", box.x}, {"y", box.y}, {"width", box.width}, {"height", box.height}};
  for (const auto& [name, number] : numbers)
    if (!(std::abs(number) <= kMaxCoordinate_px)) return wrong_number(file_, reported.line, name, number);
  if (!std::isfinite(reported.score)) return wrong_number(file_, reported.line, "score", reported.score);
  if (box.width > 0 && box.height > 0) return {};
  return file_.wrong(reported.line, "the box is " + number_text(box.width, 6) + " wide and " +
                                        number_text(box.height, 6) +
                                        " high: both must be more than 0; where nothing is reported, leave out the "
                                        "frame (mot, csv, aot, coco) or write nan alone on its line (vot)");
}

Result<void> ResultsBuilder::check_place(int frame, const ReportedBox& reported) const {
  const FootageTruth& clip = file_.clip;
  if (frame < clip.first_frame || frame > clip.last_frame)
    return file_.wrong(reported.line, "frame " + std::to_string(frame) +
                                          " of the footage is not of this clip, which is " + frames_text(clip));
  const auto found = results_.frames.find(frame);
  if (found == results_.frames.end()) return {};
  const std::vector<ReportedBox>& there = found->second;
  if (!file_.options.multiple_per_frame)
    return file_.wrong(reported.line, "a second box for frame " + frame_text(frame) + ", first in line " +
                                          std::to_string(there.front().line) + ": a tracker reports one a frame");
  const auto duplicate = std::ranges::find(there, reported.track, &ReportedBox::track);
  if (reported.track == kNoTrack || duplicate == there.end()) return {};
  return file_.wrong(reported.line, "id " + std::to_string(reported.track) + " a second time in frame " +
                                        frame_text(frame) + ", first in line " + std::to_string(duplicate->line));
}

}  // namespace sigs
