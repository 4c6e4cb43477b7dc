// SPDX-License-Identifier: MIT
#include "editor/preview/opened_footage.h"

#include <fmt/format.h>

#include <array>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/threads.h"
#include "editor/preview/preview_state.h"
#include "export/export_project.h"
#include "scene/opened_project.h"
#include "video/frame_quantisers.h"

namespace sigs::editor {

std::size_t bytes_of(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

std::size_t bytes_of(const PreviewImage& image) {
  std::size_t sum = image.bgr.ground.bytes() + image.bgr.patch.bytes() + bytes_of(image.mask);
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

namespace {

cv::Rect grown(const cv::Rect& rect, int by_px, cv::Size image_px) {
  return cv::Rect(rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px) &
         cv::Rect({0, 0}, image_px);
}

// As cv::boundingRect(), which takes longer to pass over what is black.
cv::Rect bounds_of(const cv::Mat& mask) {
  int first = 0;
  int end = mask.rows;
  while (first < end && cv::countNonZero(mask.row(first)) == 0) ++first;
  while (end > first && cv::countNonZero(mask.row(end - 1)) == 0) --end;
  if (first == end) return {};
  return cv::boundingRect(mask.rowRange(first, end)) + cv::Point(0, first);
}

void copy_part(const Frame& from, const cv::Rect& pixels, Frame& to) {
  for (int i = 0; i < from.plane_count(); ++i) {
    const auto plane = static_cast<std::size_t>(i);
    const cv::Rect part = i == 0 ? pixels : in_chroma(pixels, chroma_step(from.layout));
    cv::Mat target = to.planes[plane](part);
    from.planes[plane](part).copyTo(target);
  }
}

constexpr std::chrono::milliseconds kAfterFailure(100);  // memory may be had again; what is wanted is asked for anew

OpenedFootage opened_or_problem(const FootageId& footage) {
  Result<OpenedFootage> opened = guarded([&]() -> Result<OpenedFootage> { return opened_footage(*footage.project); },
                                         footage.project->footage.video);
  if (opened) return std::move(*opened);
  return {nullptr, std::make_shared<const Footage>(Footage{.problem = opened.error().text()})};
}

void open_in_background(const std::shared_ptr<PreviewState>& preview_state, const FootageId& footage) {
  const auto open = [preview_state, footage] {
    const Result<void> done = guarded([&]() -> Result<void> {
      preview_state->put_opened(footage, opened_or_problem(footage));
      return {};
    });
    static_cast<void>(done);  // where not even that can be said, the footage stays "being opened"
  };
  run_in_background(open);
}

DecodedFrame decoded_frame(FrameSource& source, int number) {
  Result<Frame> frame = guarded([&] { return source.read(number); });
  const std::string where = fmt::format("{}: frame {}", source.info().path.string(), number);
  if (frame && frame->damaged)
    return {std::move(*frame), where + " is damaged; another frame of the footage replaces it"};
  if (frame) return {std::move(*frame), ""};
  const FootageShape shape{.size_px = source.info().size_px, .times_s = source.info().times_s};
  return {grey_frame(shape, number), frame.error().text()};
}

}  // namespace

ShownImage shown(const std::shared_ptr<const DecodedFrame>& footage) {
  return ShownImage(std::shared_ptr<const Frame>(footage, &footage->frame));
}

Frame FootageCopies::to_composite(const std::shared_ptr<const DecodedFrame>& footage) {
  const bool is_other = std::exchange(footage_, footage) != footage;
  Frame copy = std::exchange(copy_, {});
  if (!is_other && !copy.planes[0].empty()) return copy;
  // Into the same memory: new memory of the system would have to be cleared first.
  std::array<cv::Mat, 3> planes = std::move(copy.planes);
  copy = footage->frame;
  for (std::size_t i = 0; i < planes.size(); ++i) footage->frame.planes[i].copyTo(planes[i]);
  copy.planes = std::move(planes);
  return copy;
}

PatchedImage FootageCopies::patched(const std::shared_ptr<const DecodedFrame>& footage, ComposedFrame& composed) {
  const cv::Size size_px = footage->frame.size_px();
  PatchedImage image{.ground = shown(footage), .patch = {}, .patch_at = {}};
  if (const cv::Rect masked = bounds_of(composed.mask); !masked.empty()) {
    const cv::Rect changed = with_chroma_reach(masked, size_px);
    const cv::Rect part = grown(changed, kPatchMargin_px, size_px);
    const cv::Rect kept = with_chroma_reach(part, size_px);
    image.patch = ShownImage(std::make_shared<const Frame>(part_of(composed.image, kept)), part - kept.tl());
    image.patch_at = part.tl();
    copy_part(footage->frame, changed, composed.image);
  }
  copy_ = std::move(composed.image);
  return image;
}

void run_decoder(const std::shared_ptr<PreviewState>& preview_state) {
  std::unique_ptr<FrameSource> source;
  const auto step = [&]() -> Result<bool> {
    std::optional<DecodeTask> task = preview_state->next_decoding();
    if (!task) return false;
    if (task->adopt) source = std::move(task->source);
    if (task->open) open_in_background(preview_state, *task->open);
    if (task->decode)
      preview_state->put_decoded(*task->decode,
                                 std::make_shared<const DecodedFrame>(decoded_frame(*source, task->decode->frame)));
    return true;
  };
  for (Result<bool> keep_running = true; keep_running.value_or(true); keep_running = guarded(step))
    if (!keep_running) std::this_thread::sleep_for(kAfterFailure);
}

}  // namespace sigs::editor
