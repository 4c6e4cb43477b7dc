// SPDX-License-Identifier: MIT
#include "cli/labelled_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "base/image_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/process.h"
#include "labels/labels.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

Result<void> check_size(const fs::path& path, cv::Size size, const FootageTruth& footage) {
  if (size == footage.size_px || footage.size_px.empty()) return {};
  return fail(path.string(),
              fmt::format("is {}, the labels are of {}", image_size_text(size), image_size_text(footage.size_px)));
}

Result<void> check_count(const fs::path& path, int count, const ClipTruth& clip) {
  if (count == clip.frames()) return {};
  return fail(path.string(), fmt::format("has {} frames, the labels have {}", count, clip.frames()));
}

bool is_image_of(const fs::path& path, ImageNames names) {
  const std::string extension = lower_extension(path);
  if (names == ImageNames::by_frame)
    return path.filename().string().starts_with("frame_") && path.extension() == ".png";
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp";
}

// In order of the number at the end of the name, those without behind, then of the name.
Result<std::vector<fs::path>> images_by_number(const fs::path& folder, ImageNames names) {
  Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  std::erase_if(*paths, [&](const fs::path& path) { return !is_image_of(path, names); });
  const auto number_at_end = [](const fs::path& path) {
    const std::string stem = path.stem().string();
    const std::size_t begin = stem.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
    std::string digits = stem.substr(begin);
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return std::pair(digits.size(), digits);  // as numbers of any length are compared
  };
  std::ranges::stable_sort(*paths, {}, number_at_end);
  return paths;
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
                fmt::format("has neither {}.mkv, .mp4, .avi nor a folder {} beside it; name its images with --video",
                            labels.stem().string(), labels.stem().string()),
                ErrorKind::cannot_read);
  if (found.size() > 1)
    return fail(labels.string(),
                fmt::format("has both {} and {} beside it; choose with --video", found[0].filename().string(),
                            found[1].filename().string()),
                ErrorKind::cannot_read);
  return found.front();
}

Result<LabelledImages> LabelledImages::open(const fs::path& path, const ClipTruth& clip, ImageNames names) {
  LabelledImages images(path, clip.footage);
  if (is_folder(path)) {
    Result<std::vector<fs::path>> files = images_by_number(path, names);
    if (!files) return fail(files.error());
    if (const Result<void> fits = check_count(path, static_cast<int>(files->size()), clip); !fits)
      return fail(fits.error());
    for (int frame = clip.footage.first_frame; frame <= clip.footage.last_frame && names == ImageNames::by_frame;
         ++frame)
      (*files)[static_cast<std::size_t>(frame - clip.footage.first_frame)] = path / image_name(frame);
    images.files_ = std::move(*files);
    const Result<cv::Mat> first = images.at(clip.footage.first_frame);
    if (!first) return fail(first.error());
    images.footage_.size_px = first->size();  // of all others too, where the labels state none
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
  const fs::path& file = files_[static_cast<std::size_t>(frame - footage_.first_frame)];
  Result<cv::Mat> image = read_image_file(file, cv::IMREAD_COLOR);
  if (!image) return fail(image.error());
  if (const Result<void> fits = check_size(file, image->size(), footage_); !fits) return fail(fits.error());
  return image;
}

}  // namespace sigs::cli
