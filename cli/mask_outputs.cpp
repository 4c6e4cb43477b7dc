// SPDX-License-Identifier: MIT
#include "cli/mask_outputs.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "base/paths.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

const cv::Vec3b kTint(255, 0, 255);  // magenta: neither sky nor ground nor paint
constexpr double kStrength = 0.5;

// The image with the mask tinted over it, for inspection. bgr: CV_8UC3; mask: CV_8UC1 of the same size.
cv::Mat tinted(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Mat image = bgr.clone();
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double share = kStrength * mask.at<uchar>(y, x) / 255.0;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + share * (kTint[i] - pixel[i]));
    }
  return image;
}

// The file names of every method's steps, and of the frame and the result around them.
constexpr std::string_view kStages[] = {
    "frame", "overlay",
    // paper
    "difference_sum", "canny", "dilated", "rough", "sobel", "closed", "padded", "filled", "refined",
    // stable
    "mean_gradient", "coherence", "variation", "drift", "moving", "walls", "labels", "own_body", "confidence"};

bool is_taken_by_a_stage(const fs::path& file, const fs::path& stages) {
  if (!is_at_or_below(file, stages) || file == stages) return false;
  const fs::path first = *file.lexically_relative(stages).begin();
  return is_stage_name(first.string());
}

// Two outputs with the same path.
Result<void> check_distinct(const MaskPaths& paths) {
  const fs::path mask = canonical_name(paths.mask);
  const fs::path confidence = paths.confidence.empty() ? fs::path() : canonical_name(paths.confidence);
  if (!confidence.empty() && (is_at_or_below(confidence, mask) || is_at_or_below(mask, confidence)))
    return fail("--confidence " + paths.confidence.string(), "is where the mask goes", ErrorKind::usage);
  if (paths.stages.empty()) return {};
  const fs::path stages = canonical_path(paths.stages);
  const std::pair<std::string, fs::path> files[] = {{"--out " + paths.mask.string(), mask},
                                                    {"--confidence " + paths.confidence.string(), confidence}};
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    if (is_at_or_below(stages, file))
      return fail(option, "is the folder that --stages makes; choose another name", ErrorKind::usage);
    if (is_taken_by_a_stage(file, stages))
      return fail(option, "is a name that --stages writes; choose another", ErrorKind::usage);
  }
  return {};
}

std::vector<fs::path> stages_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (is_stage_name(entry.path().filename().string())) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool is_stage_name(std::string_view file_name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (file_name.size() < 8 || !is_digit(file_name[0]) || !is_digit(file_name[1]) || file_name[2] != '_' ||
      !file_name.ends_with(".png"))
    return false;
  return std::ranges::find(kStages, file_name.substr(3, file_name.size() - 7)) != std::end(kStages);
}

fs::path MaskOutputs::stage(std::size_t number, std::string_view name) const {
  std::string file = std::to_string(number);
  if (number < 10) file.insert(0, 1, '0');
  return paths_.stages / file.append("_").append(name).append(".png");
}

// Reserves the name of an image, in a folder that is created if it is missing.
Result<void> MaskOutputs::reserve(const char* option, const fs::path& path, const std::vector<fs::path>& inputs) {
  Result<void> step = check_png_output(option, path, inputs);
  if (step) step = folders_.make(path.parent_path());
  if (step) step = files_.reserve(path);
  return step;
}

// Which steps there will be is known only at the end; any existing one is an error.
Result<void> MaskOutputs::reserve_stages(const std::vector<fs::path>& inputs) {
  if (const Result<void> made = folders_.make(paths_.stages); !made) return made;
  const std::vector<fs::path> there = stages_in(paths_.stages);
  if (!overwrite_ && !there.empty())
    return fail(there.front().string(), "exists already; --force replaces the stages that are there",
                ErrorKind::cannot_create);
  if (const Result<void> kept = check_inputs_not_overwritten(there, inputs); !kept) return kept;
  return files_.reserve(stage(0, "frame"));
}

Result<MaskOutputs> MaskOutputs::reserved(MaskPaths paths, const std::vector<fs::path>& inputs, bool overwrite) {
  if (const Result<void> apart = check_distinct(paths); !apart) return fail(apart.error());
  MaskOutputs out(std::move(paths), overwrite);
  Result<void> step = out.reserve("--out", out.paths_.mask, inputs);
  if (step && !out.paths_.confidence.empty()) step = out.reserve("--confidence", out.paths_.confidence, inputs);
  if (step && out.has_stages()) step = out.reserve_stages(inputs);
  if (!step) return fail(step.error());
  return out;
}

// The steps of the method, between a frame of the footage and that frame with the result tinted over it.
Result<void> MaskOutputs::write_stages(const OwnBody& found, const cv::Mat& bgr) {
  Result<void> step = files_.write(stage(0, "frame"), bgr);
  std::size_t number = 1;
  for (const DetectionStage& made : found.stages)
    if (step) step = files_.write(stage(number++, made.name), made.image);
  if (step) step = files_.write(stage(number, "overlay"), tinted(bgr, found.mask));
  return step;
}

Result<std::vector<fs::path>> MaskOutputs::write(const OwnBody& found, const cv::Mat& bgr) {
  Result<void> step = files_.write(paths_.mask, found.mask);
  if (step && !paths_.confidence.empty()) step = files_.write(paths_.confidence, found.confidence);
  if (step && has_stages()) step = write_stages(found, bgr);
  if (!step) return fail(step.error());
  Result<std::vector<fs::path>> written = files_.commit();
  if (!written || !has_stages() || !overwrite_) return written;
  std::error_code code;
  for (const fs::path& there : stages_in(paths_.stages))
    if (std::find(written->begin(), written->end(), there) == written->end() && !fs::is_directory(there, code))
      fs::remove(there, code);
  return written;
}

}  // namespace sigs::cli
