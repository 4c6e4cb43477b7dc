// SPDX-License-Identifier: MIT
#include "labelled_images.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <system_error>
#include <vector>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/threads.h"
#include "interrupt.h"
#include "labels/labels.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Result<void> check_size(const fs::path& path, cv::Size size, const FootageTruth& footage) {
  if (size == footage.size_px) return {};
  return fail(path.string(), "is " + size_text(size) + ", the labels are of " + size_text(footage.size_px));
}

Result<void> check_count(const fs::path& path, int count, const ClipTruth& clip) {
  if (count == clip.frames()) return {};
  return fail(path.string(),
              "has " + std::to_string(count) + " frames, the labels have " + std::to_string(clip.frames()));
}

Result<int> image_count_in(const fs::path& folder) {
  const Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  return static_cast<int>(std::count_if(paths->begin(), paths->end(), [](const fs::path& path) {
    return path.filename().string().starts_with("frame_") && path.extension() == ".png";
  }));
}

// Empty: it cannot be read.
cv::Mat read_image(const fs::path& file) {
  try {
    return cv::imread(file.string(), cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
    return {};
  }
}

}  // namespace

Result<fs::path> LabelledImages::beside(const fs::path& labels) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const char* const extension : {".mkv", ".mp4", ".avi", ""})
    if (const fs::path path = fs::path(labels).replace_extension(extension); fs::exists(path, code))
      found.push_back(path);
  if (found.empty())
    return fail(labels.string(),
                "has neither " + labels.stem().string() + ".mkv, .mp4, .avi nor a folder " + labels.stem().string() +
                    " beside it; name its images with --video",
                ErrorKind::cannot_read);
  if (found.size() > 1)
    return fail(labels.string(),
                "has both " + found[0].filename().string() + " and " + found[1].filename().string() +
                    " beside it; choose with --video",
                ErrorKind::cannot_read);
  return found.front();
}

Result<LabelledImages> LabelledImages::open(const fs::path& path, const ClipTruth& clip) {
  LabelledImages images(path, clip.footage);
  if (is_folder(path)) {
    const Result<int> count = image_count_in(path);
    if (!count) return fail(count.error());
    if (const Result<void> fits = check_count(path, *count, clip); !fits) return fail(fits.error());
    if (const Result<cv::Mat> first = images.at(clip.footage.first_frame); !first) return fail(first.error());
    return images;
  }
  Result<FrameSource> video = FrameSource::open(path, &interrupt_flag());
  if (!video) return fail(video.error());
  Result<void> fits = check_size(path, video->info().size_px, clip.footage);
  if (fits) fits = check_count(path, video->info().frame_count(), clip);
  if (!fits) return fail(fits.error());
  images.video_ = std::move(*video);
  return images;
}

Result<cv::Mat> LabelledImages::at(int frame) {
  if (video_) {
    const Result<Frame> image = video_->read(frame - footage_.first_frame);
    if (!image) return fail(image.error());
    return bgr_of(*image);
  }
  const fs::path file = path_ / image_name(frame);
  if (const Result<void> there = check_input_file(file, "image"); !there) return fail(there.error());
  const cv::Mat image = read_image(file);
  if (image.empty()) return fail(file.string(), "cannot be read as an image");
  if (const Result<void> fits = check_size(file, image.size(), footage_); !fits) return fail(fits.error());
  return image;
}

}  // namespace sigs::cli
