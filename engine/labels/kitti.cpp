// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"
#include "truth/measure.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// 0 entirely in the image, 1 up to half of it outside, 2 more. The benchmark names the levels, not their limits.
int truncation_level(const IntruderTruth& truth) {
  constexpr double kMinOutside = 0.01;
  const double outside = 1 - truth.inside_fraction;
  if (outside <= kMinOutside) return 0;
  return outside <= 0.5 ? 1 : 2;
}

// 0 fully visible, 1 partly occluded, 2 largely occluded.
int occlusion_level(const IntruderTruth& truth) {
  if (!is_occluded(truth)) return 0;
  return occluded_fraction(truth) <= 0.5 ? 1 : 2;
}

// left top right bottom; all are edges, so that right - left is the width.
std::string edges_text(const cv::Rect& box) {
  return fmt::format("{} {} {} {}", box.x, box.y, box.x + box.width, box.y + box.height);
}

// Each with a blank before it.
std::string numbers_text(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text.append(" ").append(number_text(number, kLabelDecimals));
  return text;
}

// A region to ignore: what is not known of it has the benchmark's placeholder values.
std::string region_row(int frame, const cv::Rect& box) {
  return fmt::format("{} -1 DontCare -1 -1 -10 {} -1 -1 -1 -1000 -1000 -1000 -10\n", frame, edges_text(box));
}

std::string calibration(const LensParameters& lens) {
  const std::string matrix = numbers_text({lens.fx, 0, lens.cx, 0, 0, lens.fy, lens.cy, 0, 0, 0, 1, 0}) + "\n";
  std::string text;
  for (const char* camera : {"P0:", "P1:", "P2:", "P3:"}) text += camera + matrix;
  // The tracking benchmark's names, without colons. The laser scanner (axes X forward, Y left, Z up) and the inertial
  // unit are at the camera's position.
  return text +
         "R_rect 1 0 0 0 1 0 0 0 1\nTr_velo_cam 0 -1 0 0 0 0 -1 0 1 0 0 0\nTr_imu_velo 1 0 0 0 0 1 0 0 0 0 1 0\n";
}

class KittiLabels : public LabelWriter {
 public:
  KittiLabels(fs::path folder, std::string name, TextFile labels, LabelSequence sequence)
      : folder_(std::move(folder)),
        name_(std::move(name)),
        labels_(std::move(labels)),
        sequence_(std::move(sequence)),
        own_body_(own_body_boxes(sequence_.own_body)) {}

  Result<void> write(const FrameTruth& truth) override {
    const int frame = truth.index - sequence_.footage.first_frame;
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds)) text += row(frame, truth, intruder);
    for (const cv::Rect& box : own_body_) text += region_row(frame, box);
    for (const cv::Rect& box : truth.real_aircraft) text += region_row(frame, box);
    if (const Result<void> pose = write_pose(truth); !pose) return pose;
    return labels_.put(text);
  }

  Result<void> finish(const fs::path& images) override {
    if (const Result<void> closed = labels_.close(); !closed) return closed;
    for (std::optional<TextFile>* const file : {&poses_, &pose_sources_})
      if (*file)
        if (const Result<void> closed = (*file)->close(); !closed) return closed;
    return link_numbered_images(images, sequence_.footage, folder_ / "image_02" / name_,
                                {.first = 0, .digits = 6, .extension = sequence_.image_extension});
  }

 private:
  // The camera's pose of each frame, where it comes from a log: poses/NAME.txt and, with source and deviation,
  // poses/NAME.csv. Of a scene, all frames have a source or none has.
  Result<void> write_pose(const FrameTruth& truth) {
    if (!has_source(truth.camera)) return {};
    if (!poses_)
      if (const Result<void> begun = begin_poses(); !begun) return begun;
    if (const Result<void> put = poses_->put(kitti_pose_row(truth)); !put) return put;
    return pose_sources_->put(camera_csv_row(truth));
  }

  Result<void> begin_poses() {
    if (const Result<void> created = make_inner_folder(folder_ / "poses"); !created) return created;
    Result<TextFile> poses = TextFile::create(folder_ / "poses" / (name_ + ".txt"));
    if (!poses) return fail(poses.error());
    Result<TextFile> sources = TextFile::create(folder_ / "poses" / (name_ + ".csv"));
    if (!sources) return fail(sources.error());
    poses_ = std::move(*poses);
    pose_sources_ = std::move(*sources);
    return pose_sources_->put(std::string(kCameraCsvHeader) + "\n");
  }

  [[nodiscard]] std::string row(int frame, const FrameTruth& truth, const IntruderTruth& intruder) const {
    const LabelledIntruder& labelled = labelled_intruder(sequence_, intruder.id);
    const KittiBox box = kitti_box(truth, intruder, labelled.low_m, labelled.high_m);
    return fmt::format("{} {} {} {} {}{} {}{}\n", frame, intruder.id, word_name(labelled.category),
                       truncation_level(intruder), occlusion_level(intruder), numbers_text({box.alpha_rad}),
                       edges_text(*intruder.visible_box),
                       numbers_text({box.height_m, box.width_m, box.length_m, box.bottom_optical_m.x,
                                     box.bottom_optical_m.y, box.bottom_optical_m.z, box.rotation_y_rad}));
  }

  fs::path folder_;
  std::string name_;
  TextFile labels_;
  LabelSequence sequence_;
  std::vector<cv::Rect> own_body_;
  std::optional<TextFile> poses_;
  std::optional<TextFile> pose_sources_;
};

// TrackEval's list of sequences: name, "empty", first frame, number of frames.
std::string seqmap(const std::string& name, const FootageTruth& footage) {
  return fmt::format("{} empty 000000 {:06}\n", name, frame_count(footage));
}

}  // namespace

KittiBox kitti_box(const FrameTruth& frame, const IntruderTruth& intruder, const glm::dvec3& low_m,
                   const glm::dvec3& high_m) {
  const glm::dquat camera_from_body = glm::conjugate(frame.world_from_camera) * intruder.world_from_body;
  const glm::dvec3 size_m = high_m - low_m;
  const glm::dvec3 center_optical_m = optical_of(intruder.position_m + camera_from_body * (0.5 * (low_m + high_m)));
  const glm::dvec3 nose_optical = optical_of(camera_from_body * glm::dvec3(1, 0, 0));
  KittiBox box{.height_m = size_m.z,
               .width_m = size_m.y,
               .length_m = size_m.x,
               .bottom_optical_m = center_optical_m + glm::dvec3(0, 0.5 * size_m.z, 0)};
  // The horizontal component of a nose along y is rounding error and has no direction.
  constexpr double kVertical_m = 1e-9;
  const bool is_upright = std::hypot(nose_optical.x, nose_optical.z) < kVertical_m;
  box.rotation_y_rad = is_upright ? 0 : std::atan2(-nose_optical.z, nose_optical.x);
  const double sight_rad = std::atan2(box.bottom_optical_m.x, box.bottom_optical_m.z);
  box.alpha_rad = std::remainder(box.rotation_y_rad - sight_rad, 2 * std::numbers::pi);
  return box;
}

Result<std::unique_ptr<LabelWriter>> open_kitti(const fs::path& path, const LabelSequence& sequence) {
  const std::string name = word_name(sequence.name);
  if (const Result<void> created = make_inner_folder(path / "label_02"); !created) return fail(created.error());
  const Result<void> map =
      write_text(path / "evaluate_tracking.seqmap.training", seqmap(name, sequence.footage), false);
  if (!map) return fail(map.error());
  if (sequence.camera) {
    if (const Result<void> created = make_inner_folder(path / "calib"); !created) return fail(created.error());
    const Result<void> calib =
        write_text(path / "calib" / (name + ".txt"), calibration(sequence.camera->lens.pinhole().parameters()), false);
    if (!calib) return fail(calib.error());
  }
  Result<TextFile> labels = TextFile::create(path / "label_02" / (name + ".txt"));
  if (!labels) return fail(labels.error());
  return std::make_unique<KittiLabels>(path, name, std::move(*labels), sequence);
}

}  // namespace sigs
