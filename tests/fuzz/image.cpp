// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "base/image.h"
#include "fuzz/fuzz_input.h"
#include "mesh/materials.h"
#include "scene/scene_files.h"
#include "video/frame_source.h"
#include "video/image_sequence.h"

namespace sigs::fuzz {

namespace {

void try_mask(const std::filesystem::path& path) {
  constexpr int kWidth_px = 8;
  constexpr int kHeight_px = 6;
  const Result<cv::Mat> mask = read_own_body_mask(path, {kWidth_px, kHeight_px});
  if (!mask) return check_message(mask.error());
  ENSURE(mask->size() == cv::Size(kWidth_px, kHeight_px) && mask->type() == CV_32FC1);
  ENSURE(cv::checkRange(*mask, true, nullptr, 0.0, 1.0 + 1e-6));  // the last is excluded
}

void try_sequence(const std::filesystem::path& folder) {
  Result<FrameSource> source = FrameSource::open(folder);
  if (!source) return check_message(source.error());
  check_messages(source->info().warnings);
  const Result<Frame> frame = source->read(0);
  if (!frame) return check_message(frame.error());
  ENSURE(!frame->planes.empty() && frame->planes.front().size() == source->info().size_px);
}

void try_times(const std::filesystem::path& path) {
  const Result<std::vector<double>> times_s = read_image_times(path, {"0.png", "1.png", "2.png"});
  if (!times_s) return check_message(times_s.error());
  ENSURE(times_s->size() == 3 && times_s->front() == 0);
  for (std::size_t i = 1; i < times_s->size(); ++i)
    ENSURE(std::isfinite((*times_s)[i]) && (*times_s)[i] > (*times_s)[i - 1]);
}

}  // namespace

void try_image(const FuzzInput& input) {
  const std::filesystem::path path = input.file("paint.png");
  try_mask(path);
  try_times(path);
  TextureCache cache;
  if (const cv::Mat texture = cache.texture(path); !texture.empty()) {
    ENSURE(texture.type() == CV_8UC4);
    ENSURE(texture_problem(path).empty());
  }
  const std::filesystem::path folder = input.folder / "images";
  std::filesystem::create_directories(folder);
  static_cast<void>(FuzzInput{input.bytes, folder}.file("0.png"));
  try_sequence(folder);
}

}  // namespace sigs::fuzz
