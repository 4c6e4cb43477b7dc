// SPDX-License-Identifier: MIT
#include "export/export_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "export/frame_stream.h"
#include "labels/formats.h"
#include "project/project.h"
#include "scene/opened_project.h"

namespace sigs {

WriterThread::WriterThread(VideoWriter writer) : writer_(std::move(writer)) {
  Result<std::thread> thread =
      started_thread([this] { write_all(); }, [this](Error error) { give_up(std::move(error)); });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(std::move(thread.error()));
}

WriterThread::~WriterThread() {
  dropped_ = true;
  static_cast<void>(join());
}

bool WriterThread::put(Frame frame, int number) {
  return queue_.put({.frame = std::move(frame), .number = number});
}

bool WriterThread::put_blank(double time_s, int number) {
  return queue_.put({.frame = {.time_s = time_s}, .number = number, .is_blank = true});
}

std::optional<FrameFailure> WriterThread::join() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  return failure_;
}

Result<void> WriterThread::finish() {
  ENSURE(!thread_.joinable() && !failure_);
  const Stopwatch watch;
  Result<void> finished = writer_.finish();
  spent_s_ += watch.elapsed_s();
  return finished;
}

void WriterThread::give_up(Error error) {
  failure_ = {at_, std::move(error)};
  queue_.close();
}

void WriterThread::write_all() {
  writer_.warm_up();  // while the first frame is being made
  while (const std::optional<Item> item = queue_.take()) {
    if (dropped_) return;
    at_ = item->number;
    const Stopwatch watch;
    const Result<void> written = item->is_blank ? writer_.write_blank(item->frame.time_s, item->number)
                                                : writer_.write(item->frame, item->number);
    spent_s_ += watch.elapsed_s();
    if (written) continue;
    return give_up(written.error());
  }
}

namespace fs = std::filesystem;

bool fits(std::string_view path, std::string_view pattern) {
  if (pattern.empty()) return path.empty();
  const std::string_view rest = pattern.substr(1);
  if (pattern.front() == '*')
    return fits(path, rest) || (!path.empty() && path.front() != '/' && fits(path.substr(1), pattern));
  if (path.empty()) return false;
  if (pattern.front() == '#')
    return path.front() >= '0' && path.front() <= '9' && (fits(path.substr(1), rest) || fits(path.substr(1), pattern));
  return path.front() == pattern.front() && fits(path.substr(1), rest);
}

Result<void> check_label_folder(const fs::path& folder, const LabelFormat& format) {
  if (format.files.empty()) return {};
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it->is_directory(code) && !it->is_symlink(code)) continue;
    const std::string path = it->path().lexically_relative(folder).generic_string();
    const auto is_written = [&path](std::string_view pattern) { return fits(path, pattern); };
    if (std::none_of(format.files.begin(), format.files.end(), is_written))
      return fail(folder.string(), fmt::format("holds {}, which no export wrote; choose another folder", path),
                  ErrorKind::cannot_create);
  }
  if (code && code != std::errc::no_such_file_or_directory)
    return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_create);
  return {};
}

namespace {

// The bytes do not depend on it.
int encoder_threads() {
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
}

VideoFormat video_format(const ExportSettings& output, const VideoInfo& footage, int threads) {
  return {.codec = output.codec,
          .container = container_of(output, footage),
          .jpeg_quality = output.jpeg_quality,
          .crf = output.crf,
          .threads = threads,
          .size_px = footage.size_px,
          .layout = footage.layout,
          .bit_depth = footage.bit_depth,
          .max_bit_depth = output.max_bit_depth,
          .color = footage.color,
          .frame_rate_num = footage.frame_rate_num,
          .frame_rate_den = footage.frame_rate_den,
          .pixel_aspect_num = footage.pixel_aspect_num,
          .pixel_aspect_den = footage.pixel_aspect_den};
}

// Masks are full-range gray, lossless, whatever the footage is.
VideoFormat mask_format(const VideoFormat& image, MasksChoice masks) {
  VideoFormat format = image;
  format.codec = masks == MasksChoice::png ? VideoCodec::png : VideoCodec::ffv1;
  format.container = Container::mkv;
  format.threads = 1;  // of a mask there is hardly anything to encode
  format.layout = PixelLayout::gray;
  format.bit_depth = 8;
  format.color = {.range = ColorRange::full, .range_stated = true};
  return format;
}

std::string with_extension(const std::string& name, const VideoFormat& format) {
  return writes_images(format.codec) ? name : name + "." + extension_of(format.container);
}

Frame frame_of_mask(cv::Mat mask, double time_s) {
  return {.layout = PixelLayout::gray,
          .color = {.range = ColorRange::full, .range_stated = true},
          .planes = {std::move(mask)},
          .time_s = time_s};
}

// video: the name of the exported video
LabelSequence label_sequence(const ExportedClip& clip, const std::string& video) {
  const Project& project = clip.request.project;
  const Scene& scene = clip.scene;
  const bool has_images = writes_images(project.output.codec);
  LabelSequence sequence{.name = project.name,
                         .footage = footage_truth(clip.footage, clip.range),
                         .categories = categories_of(project),
                         .video = has_images ? std::string() : video,
                         .channels = clip.footage.layout == PixelLayout::gray ? 1 : 3,
                         .image_extension = has_images ? image_extension_of(project.output.codec) : ".png",
                         .images = project.name,
                         .own_body = scene.own_body,
                         .camera = scene.camera,
                         .thresholds = {.min_pixels = project.output.label_min_pixels,
                                        .min_visible_fraction = project.output.label_min_visible_fraction},
                         .box_scale = project.output.label_box_scale,
                         .box_margin_px = project.output.label_box_margin_px,
                         .has_real_aircraft = !scene.real_aircraft.empty(),
                         .volumes = project.output.encounter};
  if (project.rig_view)
    sequence.mounted = {.name = project.rig_view->name, .body_from_camera = body_from_camera(project.rig_view->mount)};
  for (std::size_t i = 0; i < scene.intruders.size(); ++i)
    sequence.intruders.push_back({.id = static_cast<int>(i),
                                  .name = scene.intruders[i].name,
                                  .category = project.intruders[i].category,
                                  .low_m = scene.intruders[i].model->mesh.low_m,
                                  .high_m = scene.intruders[i].model->mesh.high_m});
  return sequence;
}

// A folder of images is replaced as a whole; one that contains a foreign file is not.
Result<void> check_image_folder(const fs::path& folder) {
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const std::string name = it->path().filename().string();
    const std::string extension = it->path().extension().string();
    const bool is_image = extension == ".png" || extension == ".tiff" || extension == ".jpg";
    if (!name.starts_with("frame_") || !is_image)
      return fail(folder.string(), fmt::format("holds {}, which no export wrote; choose another folder", name),
                  ErrorKind::cannot_create);
  }
  if (code && code != std::errc::no_such_file_or_directory)
    return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_create);
  return {};
}

struct OutputPaths {
  fs::path base;  // FOLDER/NAME
  fs::path video;
  fs::path masks;
  fs::path encounter;
  std::vector<fs::path> all;
};

OutputPaths output_paths(const ExportRequest& request, const VideoFormat& video, const VideoFormat& masks) {
  const fs::path base = request.folder / request.project.name;
  OutputPaths paths{.base = base,
                    .video = with_extension(base.string(), video),
                    .masks = with_extension(base.string() + ".masks", masks),
                    .encounter = base.string() + std::string(kEncounterSuffix)};
  paths.all = {paths.video, paths.masks};
  for (const std::string& label : request.project.output.labels)
    paths.all.push_back(base.string() + std::string(label_format(label)->suffix));
  if (!request.project.output.encounter.empty()) paths.all.push_back(paths.encounter);
  return paths;
}

}  // namespace

Result<ExportFiles::OpenedVideo> ExportFiles::open_video(const fs::path& path, const VideoFormat& format,
                                                         const SplicePlan* splice, const std::atomic<bool>* cancel) {
  const Result<fs::path> staged =
      writes_images(format.codec) ? outputs_.add_folder(path, check_image_folder) : outputs_.add_file(path);
  if (!staged) return fail(staged.error());
  Result<VideoWriter> writer =
      splice == nullptr ? VideoWriter::open(*staged, format) : VideoWriter::open_splice(*staged, *splice, cancel);
  if (!writer) return fail(writer.error());
  return OpenedVideo{*staged, std::make_unique<WriterThread>(std::move(*writer))};
}

Result<ExportFiles::Labels> ExportFiles::open_labels(const fs::path& path, const LabelFormat& format,
                                                     const LabelSequence& sequence) {
  const auto may_replace = [&format](const fs::path& folder) { return check_label_folder(folder, format); };
  const Result<fs::path> staged = format.is_folder ? outputs_.add_folder(path, may_replace) : outputs_.add_file(path);
  if (!staged) return fail(staged.error());
  Result<std::unique_ptr<LabelWriter>> writer = format.open(*staged, sequence);
  if (!writer) return fail(writer.error());
  return Labels{std::move(*writer)};
}

// What is in the file is known before the first frame.
Result<void> ExportFiles::write_encounters(const fs::path& path, const ExportedClip& clip) {
  Result<ExportedEncounters> encounters = ExportedEncounters::of(clip.request.project, clip.scene, clip.range);
  if (!encounters) return fail(encounters.error());
  encounters_ = *std::move(encounters);
  const Result<fs::path> staged = outputs_.add_file(path);
  return staged ? encounters_->write_json(*staged) : fail(staged.error());
}

Result<ExportFiles> ExportFiles::open(const ExportedClip& clip) {
  ExportFiles files(clip.request.overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse);
  if (clip.request.video_descriptor < 0)
    if (const Result<void> folder = files.folders_.make(clip.request.folder); !folder) return fail(folder.error());
  const Result<void> opened = files.open_all(clip);
  if (!opened) return fail(files.outputs_.with_final_names(opened.error()));
  return files;
}

Result<void> ExportFiles::open_all(const ExportedClip& clip) {
  const ExportRequest& request = clip.request;
  if (request.labels_descriptor >= 0)
    if (const Result<void> opened = open_label_stream(clip); !opened) return opened;
  if (request.video_descriptor < 0) return open_files(clip);
  if (!request.project.output.encounter.empty()) {
    Result<ExportedEncounters> encounters = ExportedEncounters::of(request.project, clip.scene, clip.range);
    if (!encounters) return fail(encounters.error());
    encounters_ = *std::move(encounters);
  }
  return open_video_stream(clip);
}

Result<void> ExportFiles::open_video_stream(const ExportedClip& clip) {
  Result<OutputStream> out = OutputStream::of_descriptor(clip.request.video_descriptor, "standard output", clip.cancel);
  if (!out) return fail(out.error());
  Result<VideoWriter> writer = VideoWriter::open_stream(
      std::move(*out), video_format(clip.request.project.output, clip.footage, encoder_threads()));
  if (!writer) return fail(writer.error());
  video_ = std::make_unique<WriterThread>(std::move(*writer));
  return {};
}

Result<void> ExportFiles::open_label_stream(const ExportedClip& clip) {
  const int descriptor = clip.request.labels_descriptor;
  Result<OutputStream> out =
      OutputStream::of_descriptor(descriptor, fmt::format("labels, descriptor {}", descriptor), clip.cancel);
  if (!out) return fail(out.error());
  labels_.push_back({std::make_unique<JsonLinesStream>(std::move(*out), label_sequence(clip, ""))});
  return {};
}

Result<void> ExportFiles::open_files(const ExportedClip& clip) {
  const ExportSettings& output = clip.request.project.output;
  const VideoFormat format = video_format(output, clip.footage, encoder_threads());
  const VideoFormat masks = mask_format(format, output.masks);
  const OutputPaths paths = output_paths(clip.request, format, masks);
  if (const Result<void> kept = check_inputs_not_overwritten(clip.request.project, paths.all, "export"); !kept)
    return kept;
  Result<OpenedVideo> video = open_video(paths.video, format, clip.splice, clip.cancel);
  if (!video) return fail(video.error());
  video_ = std::move(video->writer);
  if (writes_images(format.codec)) image_folder_ = video->staged;
  if (output.masks != MasksChoice::none) {
    Result<OpenedVideo> opened = open_video(paths.masks, masks);
    if (!opened) return fail(opened.error());
    masks_ = std::move(opened->writer);
  }
  const LabelSequence sequence = label_sequence(clip, paths.video.filename().string());
  for (const std::string& label : output.labels) {
    const LabelFormat& chosen = *label_format(label);
    Result<Labels> labels = open_labels(paths.base.string() + std::string(chosen.suffix), chosen, sequence);
    if (!labels) return fail(labels.error());
    labels_.push_back(std::move(*labels));
  }
  return output.encounter.empty() ? Result<void>() : write_encounters(paths.encounter, clip);
}

bool ExportFiles::write_labels(const FrameTruth& truth) {
  bool goes_on = true;
  for (Labels& labels : labels_) {
    if (labels.failure) continue;
    const Result<void> written = labels.writer->write(truth);
    if (written) continue;
    labels.failure = {truth.index, written.error()};
    goes_on = false;
  }
  return goes_on;
}

Result<void> ExportFiles::write(ComposedFrame frame) {
  if (encounters_) encounters_->add_to(frame.truth);
  const int number = frame.truth.index;
  const double time_s = frame.image.time_s;
  bool goes_on = write_labels(frame.truth);
  const bool is_copied = frame.image.planes[0].empty();
  if (goes_on && !is_copied) goes_on = video_->put(std::move(frame.image), number);
  if (masks_) {
    WriterThread& masks = *masks_;
    goes_on &= frame.mask.empty() ? masks.put_blank(time_s, number)
                                  : masks.put(frame_of_mask(std::move(frame.mask), time_s), number);
  }
  return goes_on ? Result<void>() : join();
}

Result<void> ExportFiles::join() {
  std::vector<std::optional<FrameFailure>> failures{video_->join()};
  if (masks_) failures.push_back(masks_->join());
  for (const Labels& labels : labels_) failures.push_back(labels.failure);
  std::erase(failures, std::nullopt);
  if (failures.empty()) return {};
  const auto first = std::min_element(failures.begin(), failures.end(),
                                      [](const auto& a, const auto& b) { return a->frame < b->frame; });
  return fail(outputs_.with_final_names((*first)->error));
}

double ExportFiles::spent_s() const {
  return video_->spent_s() + (masks_ ? masks_->spent_s() : 0);
}

Result<void> ExportFiles::finish() {
  Result<void> step = join();
  if (step) step = video_->finish();
  if (step && masks_) step = masks_->finish();
  for (Labels& labels : labels_)
    if (step) step = labels.writer->finish(image_folder_);
  return step ? step : fail(outputs_.with_final_names(step.error()));
}

Result<std::vector<fs::path>> ExportFiles::commit(StagedOutputs* later) {
  if (const Result<void> step = finish(); !step) return fail(step.error());
  std::vector<fs::path> names = outputs_.final_paths();
  if (later != nullptr)
    later->take(std::move(outputs_));
  else if (const Result<void> kept = outputs_.commit(); !kept)
    return fail(kept.error());
  return names;
}

}  // namespace sigs
