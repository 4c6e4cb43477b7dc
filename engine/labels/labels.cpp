// SPDX-License-Identifier: MIT
#include "labels/labels.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "labels/aot.h"
#include "labels/coco.h"
#include "labels/csv.h"
#include "labels/cvat.h"
#include "labels/kitti.h"
#include "labels/mot.h"
#include "labels/sigs_xml.h"
#include "labels/voc.h"
#include "labels/vot.h"
#include "labels/yolo.h"

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

bool is_labelled(const IntruderTruth& truth, const LabelThresholds& thresholds) {
  return truth.visible_box && truth.visible_pixels >= thresholds.min_pixels &&
         truth.visible_fraction >= thresholds.min_visible_fraction;
}

std::string image_name(int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%06d.png", frame);
  return name.data();
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
