// SPDX-License-Identifier: MIT
#include "labels/kitti.h"

#include <string>
#include <utility>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/kitti_box.h"
#include "labels/label_text.h"
#include "labels/numbered_images.h"
#include "labels/own_body_boxes.h"
#include "labels/text_file.h"
#include "truth/measure.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr int kDecimals = 6;

// 0 wholly in the image, 1 less than half of it beyond, 2 more. The benchmark names the levels, not their limits.
int truncation_level(const IntruderTruth& truth) {
  constexpr double kMinBeyond = 0.01;
  const double beyond = 1 - truth.inside_fraction;
  if (beyond <= kMinBeyond) return 0;
  return beyond <= 0.5 ? 1 : 2;
}

// 0 fully visible, 1 partly occluded, 2 largely occluded.
int occlusion_level(const IntruderTruth& truth) {
  if (!is_occluded(truth)) return 0;
  return occluded_fraction(truth) <= 0.5 ? 1 : 2;
}

// left top right bottom; right and bottom are edges, so that their difference is the size.
std::string box_text(const cv::Rect& box) {
  return joined({box.x, box.y, box.x + box.width, box.y + box.height}, " ");
}

std::string numbers_text(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text.append(" ").append(number_text(number, kDecimals));
  return text;
}

// What is not known of a region to ignore has the values that the benchmark gives it.
std::string region_row(int frame, const cv::Rect& box) {
  return std::to_string(frame) + " -1 DontCare -1 -1 -10 " + box_text(box) + " -1 -1 -1 -1000 -1000 -1000 -10\n";
}

std::string calibration(const LensParameters& lens) {
  const std::string matrix = numbers_text({lens.fx, 0, lens.cx, 0, 0, lens.fy, lens.cy, 0, 0, 0, 1, 0}) + "\n";
  std::string text;
  for (const char* camera : {"P0:", "P1:", "P2:", "P3:"}) text += camera + matrix;
  // The tracking benchmark's names, without colons. A laser scanner's axes are X forward, Y left, Z up; here it is
  // where the camera is, and so is the inertial unit.
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
    return labels_.put(text);
  }

  Result<void> finish(const fs::path& images) override {
    if (const Result<void> closed = labels_.close(); !closed) return closed;
    return link_numbered_images(images, sequence_.footage, folder_ / "image_02" / name_, {.first = 0, .digits = 6});
  }

 private:
  [[nodiscard]] std::string row(int frame, const FrameTruth& truth, const IntruderTruth& intruder) const {
    const LabelledIntruder& labelled = labelled_intruder(sequence_, intruder.id);
    const KittiBox box = kitti_box(truth, intruder, labelled.low_m, labelled.high_m);
    return std::to_string(frame) + " " + std::to_string(intruder.id) + " " + word_name(labelled.category) + " " +
           std::to_string(truncation_level(intruder)) + " " + std::to_string(occlusion_level(intruder)) +
           numbers_text({box.alpha_rad}) + " " + box_text(*intruder.visible_box) +
           numbers_text({box.height_m, box.width_m, box.length_m, box.bottom_optical_m.x, box.bottom_optical_m.y,
                         box.bottom_optical_m.z, box.rotation_y_rad}) +
           "\n";
  }

  fs::path folder_;
  std::string name_;
  TextFile labels_;
  LabelSequence sequence_;
  std::vector<cv::Rect> own_body_;
};

// TrackEval's list of sequences: name, "empty", first frame, number of frames.
std::string seqmap(const std::string& name, const FootageTruth& footage) {
  const std::string frames = std::to_string(footage.last_frame - footage.first_frame + 1);
  return name + " empty 000000 " + std::string(frames.size() < 6 ? 6 - frames.size() : 0, '0') + frames + "\n";
}

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_kitti(const fs::path& path, const LabelSequence& sequence) {
  const std::string name = word_name(sequence.name);
  if (const Result<void> made = make_inner_folder(path / "label_02"); !made) return fail(made.error());
  const Result<void> map =
      write_text(path / "evaluate_tracking.seqmap.training", seqmap(name, sequence.footage), false);
  if (!map) return fail(map.error());
  if (sequence.camera) {
    if (const Result<void> made = make_inner_folder(path / "calib"); !made) return fail(made.error());
    const Result<void> calib =
        write_text(path / "calib" / (name + ".txt"), calibration(sequence.camera->lens.parameters()), false);
    if (!calib) return fail(calib.error());
  }
  Result<TextFile> labels = TextFile::create(path / "label_02" / (name + ".txt"));
  if (!labels) return fail(labels.error());
  return std::make_unique<KittiLabels>(path, name, std::move(*labels), sequence);
}

}  // namespace sigs
