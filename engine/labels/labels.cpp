// SPDX-License-Identifier: MIT
#include "labels/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/ensure.h"
#include "labels/formats.h"

namespace sigs {

namespace {

// engine/labels/README.md lists what else a format needs.
constexpr LabelFormat kFormats[] = {
    {.name = "xml",
     .suffix = ".xml",
     .help = "SIGS annotations: everything, docs/annotation-format.md",
     .open = open_sigs_xml,
     .names_images = false,
     .has_thresholds = false},
    {.name = "coco",
     .suffix = ".coco.json",
     .help = "COCO instances JSON: run-length masks, video and track ids, own body as crowd region",
     .open = open_coco,
     .widens_boxes = true,
     .has_ignored_regions = true},
    {.name = "yolo",
     .suffix = ".yolo",
     .is_folder = true,
     .help = "YOLO folder: one text file an image, data.yaml",
     .open = open_yolo,
     .files = kYoloFiles,
     .widens_boxes = true},
    {.name = "voc",
     .suffix = ".voc",
     .is_folder = true,
     .help = "Pascal VOC folder: one XML file an image",
     .open = open_voc,
     .files = kVocFiles,
     .widens_boxes = true},
    {.name = "mot",
     .suffix = ".mot",
     .is_folder = true,
     .help = "MOTChallenge folder: gt.txt, seqinfo.ini, seqmaps",
     .open = open_mot,
     .files = kMotFiles,
     .has_ignored_regions = true},
    {.name = "kitti",
     .suffix = ".kitti",
     .is_folder = true,
     .help = "KITTI tracking folder: label_02, calib",
     .open = open_kitti,
     .files = kKittiFiles,
     .has_ignored_regions = true},
    {.name = "cvat",
     .suffix = ".cvat.xml",
     .help = "CVAT for video XML 1.1: a track for each intruder",
     .open = open_cvat,
     .names_images = false},
    {.name = "vot",
     .suffix = ".vot",
     .is_folder = true,
     .help = "VOT folder: sequence, groundtruth.txt, list.txt",
     .open = open_vot,
     .files = kVotFiles},
    {.name = "aot",
     .suffix = ".aot.json",
     .help = "Airborne Object Tracking ground truth JSON: range, side of the horizon",
     .open = open_aot},
    {.name = "csv",
     .suffix = ".csv",
     .help = "one row for each intruder and frame",
     .open = open_csv,
     .names_images = false,
     .has_thresholds = false},
    {.name = "jsonl",
     .suffix = ".jsonl",
     .help = "JSON Lines: everything of a frame on a line of its own",
     .open = open_jsonl,
     .names_images = false,
     .has_thresholds = false},
};

}  // namespace

const LabelledIntruder& labelled_intruder(const LabelSequence& sequence, int id) {
  const auto found = std::ranges::find(sequence.intruders, id, &LabelledIntruder::id);
  ENSURE(found != sequence.intruders.end());
  return *found;
}

int category_index(const LabelSequence& sequence, int id) {
  const auto category = std::ranges::find(sequence.categories, labelled_intruder(sequence, id).category);
  ENSURE(category != sequence.categories.end());
  return static_cast<int>(category - sequence.categories.begin());
}

bool is_labelled(const IntruderTruth& truth, const LabelThresholds& thresholds) {
  return truth.visible_box && truth.visible_pixels >= thresholds.min_pixels &&
         truth.visible_fraction >= thresholds.min_visible_fraction;
}

cv::Rect labelled_box(const IntruderTruth& truth, const LabelSequence& sequence) {
  const cv::Rect& box = *truth.visible_box;
  if (sequence.box_scale == 1 && sequence.box_margin_px == 0) return box;
  const auto by = [&](int side) {
    return static_cast<int>(std::lround(0.5 * (sequence.box_scale - 1) * side)) + sequence.box_margin_px;
  };
  const cv::Rect grown(box.x - by(box.width), box.y - by(box.height), box.width + 2 * by(box.width),
                       box.height + 2 * by(box.height));
  return grown & cv::Rect({0, 0}, sequence.footage.size_px);
}

std::string image_name(int frame, std::string_view extension) {
  return fmt::format("frame_{:06}{}", frame, extension);
}

std::span<const LabelFormat> label_formats() {
  return kFormats;
}

const LabelFormat* label_format(std::string_view name) {
  const auto* const found = std::ranges::find(kFormats, name, &LabelFormat::name);
  return found == std::end(kFormats) ? nullptr : found;
}

std::vector<std::string_view> names_without_thresholds() {
  std::vector<std::string_view> names;
  for (const LabelFormat& format : kFormats)
    if (!format.has_thresholds) names.push_back(format.name);
  return names;
}

}  // namespace sigs
