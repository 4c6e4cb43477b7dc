// SPDX-License-Identifier: MIT
#include "labels/labels.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/ensure.h"
#include "labels/formats.h"

namespace sigs {

namespace {

constexpr LabelFormat kFormats[] = {
    {"xml", ".xml", false, "SIGS annotations: everything, docs/annotation-format.md", open_sigs_xml, {}, false},
    {"coco", ".coco.json", false,
     "COCO instances JSON: run-length masks, video and track ids, own body as crowd region", open_coco},
    {"yolo", ".yolo", true, "YOLO folder: one text file an image, data.yaml", open_yolo, kYoloFiles},
    {"voc", ".voc", true, "Pascal VOC folder: one XML file an image", open_voc, kVocFiles},
    {"mot", ".mot", true, "MOTChallenge folder: gt.txt, seqinfo.ini, seqmaps", open_mot, kMotFiles},
    {"kitti", ".kitti", true, "KITTI tracking folder: label_02, calib", open_kitti, kKittiFiles},
    {"cvat", ".cvat.xml", false, "CVAT for video XML 1.1: a track for each intruder", open_cvat, {}, false},
    {"vot", ".vot", true, "VOT folder: sequence, groundtruth.txt, list.txt", open_vot, kVotFiles},
    {"aot", ".aot.json", false, "Airborne Object Tracking ground truth JSON: range, side of the horizon", open_aot},
    {"csv", ".csv", false, "one row for each intruder and frame", open_csv, {}, false},
};

}  // namespace

const LabelledIntruder& labelled_intruder(const LabelSequence& sequence, int id) {
  const auto found = std::find_if(sequence.intruders.begin(), sequence.intruders.end(),
                                  [id](const LabelledIntruder& one) { return one.id == id; });
  ENSURE(found != sequence.intruders.end());
  return *found;
}

int category_index(const LabelSequence& sequence, int id) {
  const std::string& wanted = labelled_intruder(sequence, id).category;
  const auto category = std::find(sequence.categories.begin(), sequence.categories.end(), wanted);
  ENSURE(category != sequence.categories.end());
  return static_cast<int>(category - sequence.categories.begin());
}

bool is_labelled(const IntruderTruth& truth, const LabelThresholds& thresholds) {
  return truth.visible_box && truth.visible_pixels >= thresholds.min_pixels &&
         truth.visible_fraction >= thresholds.min_visible_fraction;
}

std::string image_name(int frame) {
  return fmt::format("frame_{:06}.png", frame);
}

std::span<const LabelFormat> label_formats() {
  return kFormats;
}

const LabelFormat* label_format(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kFormats), std::end(kFormats), [&](const LabelFormat& f) { return f.name == name; });
  return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace sigs
