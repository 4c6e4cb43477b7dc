// SPDX-License-Identifier: MIT
#include "editor/preview/opened_footage.h"

#include <utility>

#include "export/export_project.h"
#include "scene/opened_project.h"
#include "video/frame_quantisers.h"

namespace sigs::editor {

std::size_t bytes_of(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

std::size_t bytes_of(const PreviewImage& image) {
  std::size_t sum = bytes_of(image.bgr.ground) + bytes_of(image.bgr.patch) + bytes_of(image.mask);
  for (const Stage& stage : image.stages) sum += bytes_of(stage.image);
  return sum;
}

std::size_t bytes_of(const DecodedFrame& decoded) {
  std::size_t sum = 0;
  for (const cv::Mat& plane : decoded.frame.planes) sum += bytes_of(plane);
  if (decoded.frame.quantisers) sum += bytes_of(decoded.frame.quantisers->blocks);
  return sum;
}

OpenedFootage opened_footage(const Project& project) {
  const auto without_video = [](std::string problem) {
    return OpenedFootage{nullptr, std::make_shared<const Footage>(Footage{.problem = std::move(problem)})};
  };
  if (project.footage.video.empty()) return without_video("no video is chosen");
  Result<FrameSource> source = open_footage(project, nullptr, quantisers_for(project));
  if (!source) return without_video(source.error().text());
  if (source->info().frame_count() == 0) return without_video(source->info().path.string() + ": has no frames");
  auto footage = std::make_shared<const Footage>(Footage{.shape = shape_of(source->info()), .video = source->info()});
  return {std::make_unique<FrameSource>(std::move(*source)), std::move(footage)};
}

std::shared_ptr<const Footage> footage_for(const Project& project, const std::shared_ptr<const Footage>& footage) {
  if (footage->video) return footage;
  return std::make_shared<const Footage>(Footage{.shape = placeholder_footage(project), .problem = footage->problem});
}

Frame grey_frame(const FootageShape& footage, int frame) {
  const cv::Size chroma((footage.size_px.width + 1) / 2, (footage.size_px.height + 1) / 2);
  const cv::Scalar grey(128);
  Frame made{.layout = PixelLayout::yuv420,
             .planes = {cv::Mat(footage.size_px, CV_8UC1, grey), cv::Mat(chroma, CV_8UC1, grey),
                        cv::Mat(chroma, CV_8UC1, grey)}};
  made.time_s = time_of_frame_s(footage, frame);
  return made;
}

}  // namespace sigs::editor
