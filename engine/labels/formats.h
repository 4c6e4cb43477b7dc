// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/output_stream.h"
#include "base/result.h"
#include "labels/label_files.h"
#include "labels/labels.h"
#include "truth/annotation.h"

namespace sigs {

// The formats in which labels are written, one function for each, all in the table of labels.cpp. README.md of this
// folder lists what a new one needs; docs/label-formats.md describes every field.
//   path      an empty file, or an empty folder where LabelFormat::is_folder
//   sequence  what is the same for all frames; ids of intruders and frames of the footage count from 0
// Errors: cannot_create; write_failed where the beginning of a file cannot be written.
//
// Images are named here as PNG files; exported as TIFF or JPEG they end so (LabelSequence::image_extension).
//
// Boxes of truth/annotation.h are boxes of whole pixels: x, y, width, height with the first pixel at 0, 0. Each comment
// says how the format counts them. k...Files lists what a format's folder may contain (LabelFormat::files).

// SIGS annotation file (docs/annotation-format.md, docs/sigs-annotations.xsd): everything that is measured, also of
// intruders that are not visible. Of the sequence the footage alone counts.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_sigs_xml(const std::filesystem::path& path,
                                                                 const LabelSequence& sequence);

// COCO instances JSON (https://cocodataset.org/#format-data), with the lists of videos and tracks that TAO and
// YouTube-VIS add.
//   bbox          [x, y, width, height] in pixels; the upper left corner of the first pixel is (0, 0)
//   area          number of visible pixels
//   segmentation  compressed run lengths of the whole image (labels/label_files.h)
//   ids           count from 1, since pycocotools takes an annotation of id 0 for none; track_id is the intruder's id,
//                 from 0
//   own body      in each image one annotation with iscrowd 1 for each part of it and each category, since pycocotools
//                 ignores a detection in a crowd region only where both are of one category
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_coco(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

// YOLO folder as Ultralytics reads it (https://docs.ultralytics.com/datasets/detect).
//   data.yaml                     the classes, from 0; without `path`, so that its paths are relative to the file
//   images/NAME/frame_000123.png  only where images are written
//   labels/NAME/frame_000123.txt  a line `class x y width height` for each box; empty where there is none, which makes
//                                 the image one of background. x and y are the centre of the box; all four are
//                                 fractions of the image's width or height
// The paths below images/ and labels/ are the same, since readers derive the one from the other. NAME is the
// sequence's, so that the folders of several videos can be merged into one.
inline constexpr std::array<std::string_view, 6> kYoloFiles{
    "data.yaml",     "images/*/frame_#.png", "images/*/frame_#.jpg", "images/*/frame_#.tiff", "labels/*/frame_#.txt",
    "labels/*.cache"};
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_yolo(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

// Pascal VOC folder (http://host.robots.ox.ac.uk/pascal/VOC/voc2012).
//   Annotations/frame_000123.xml  the first pixel is (1, 1); xmax and ymax are the last column and row of the box
//   ImageSets/Main/               train and trainval list all images, val none; likewise for each category, with 1
//                                 where an image shows it, 0 where all it shows of it is difficult, else -1
//   JPEGImages/frame_000123.png   only where images are written; PNG in spite of the folder's name, as `filename` says
// The flags follow VOC's annotation guidelines (2008 and later):
//   truncated  more than 15 % of the intruder lies outside the image
//   occluded   more than 5 % of what lies in the image is hidden
//   difficult  less than 20 % of the intruder is visible; VOC's evaluation neither requires it nor counts a detection
//              of it as false
// <trackid>, as in ImageNet VID, is the intruder's id.
inline constexpr std::array<std::string_view, 6> kVocFiles{"Annotations/frame_#.xml", "ImageSets/Main/*train.txt",
                                                           "ImageSets/Main/*val.txt", "JPEGImages/frame_#.png",
                                                           "JPEGImages/frame_#.jpg",  "JPEGImages/frame_#.tiff"};
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_voc(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

// MOTChallenge folder (https://motchallenge.net/instructions) as TrackEval reads it.
//   seqmaps/NAME.txt      list of the sequences
//   NAME/seqinfo.ini      the sequence, and the category of each class
//   NAME/gt/gt.txt        frame, id, left, top, width, height, 1 to count or 0 to ignore, class, visible fraction;
//                         frames, ids, pixels and classes count from 1
//   NAME/img1/000001.png  only where images are written
inline constexpr std::array<std::string_view, 6> kMotFiles{"seqmaps/*.txt", "*/seqinfo.ini", "*/gt/gt.txt",
                                                           "*/img1/#.png",  "*/img1/#.jpg",  "*/img1/#.tiff"};
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_mot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

// Folder of the KITTI tracking benchmark (https://www.cvlibs.net/datasets/kitti/eval_tracking.php).
//   label_02/NAME.txt            frame from 0, id, type, truncated, occluded, alpha, left top right bottom (edges, in
//                                pixels from 0), height width length, x y z, rotation_y (KittiBox)
//   calib/NAME.txt               where the sequence has a camera: the pinhole part of its lens
//   image_02/NAME/000000.png     only where images are written
//   evaluate_tracking.seqmap.training  TrackEval's list of the sequences
//   poses/NAME.txt, NAME.csv     only where the camera's pose is from a log or has a place on the Earth
inline constexpr std::array<std::string_view, 8> kKittiFiles{
    "label_02/*.txt",   "calib/*.txt",      "poses/*.txt",       "poses/*.csv",
    "image_02/*/#.png", "image_02/*/#.jpg", "image_02/*/#.tiff", "evaluate_tracking.seqmap.training"};
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_kitti(const std::filesystem::path& path,
                                                              const LabelSequence& sequence);

// The KITTI benchmarks' box of an object: rotated about the camera's vertical axis alone.
struct KittiBox {
  double height_m = 0;
  double width_m = 0;
  double length_m = 0;
  glm::dvec3 bottom_optical_m{0, 0, 0};  // centre of its lower face; x right, y down, z forward
  double rotation_y_rad = 0;             // heading of the nose about y: 0 to the right, -pi/2 away; in [-pi, pi]
  double alpha_rad = 0;                  // the heading against the line of sight: rotation_y - atan2(x, z)
};

// The box whose sides are those of the model along its own axes, whose centre is that of the model's bounds, and whose
// heading is the nose's in the camera's horizontal plane (x, z). Roll and pitch against the camera are lost, since the
// format has neither. A nose along y has the heading 0.
//   low_m, high_m  bounds of the model in body axes, relative to the reference point
[[nodiscard]] KittiBox kitti_box(const FrameTruth& frame, const IntruderTruth& intruder, const glm::dvec3& low_m,
                                 const glm::dvec3& high_m);

// CVAT for video XML 1.1 (https://docs.cvat.ai/docs/other/xml_format): a track for each intruder that has at least one
// box, since CVAT accepts no track without.
// - Frames count from 0 in the exported video. Boxes are given by their edges; the upper left corner of the first pixel
//   is (0, 0).
// - Every box is a keyframe. Where an intruder leaves, its last box follows once more with outside="1", since CVAT
//   shows a box until the next one.
// - occluded: more than 5 % of what lies in the image is hidden.
// - The own body is left out: a region that holds for a whole video would be a mask track, which CVAT does not have,
//   and a label that the task lacks makes CVAT refuse the file.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

// Folder of sequences as the VOT toolkit reads it (https://github.com/votchallenge/toolkit), one for each intruder:
// NAME, or NAME-0, NAME-1, ... where there are several.
//   list.txt                  the sequences in which the intruder is visible at least once
//   NAME/sequence             lines key=value
//   NAME/groundtruth.txt      a line for each frame: x,y,width,height from 0; nan,nan,nan,nan: no label
//   NAME/*.tag, *.value       a line for each frame: absence, occlusion; distance_m, visible_fraction
//   NAME/color/00000001.png   only where images are written
inline constexpr std::array<std::string_view, 10> kVotFiles{
    "list.txt",        "*/sequence",         "*/groundtruth.txt",        "*/absence.tag",
    "*/occlusion.tag", "*/distance_m.value", "*/visible_fraction.value", "*/color/#.png",
    "*/color/#.jpg",   "*/color/#.tiff"};
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_vot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

// Ground truth in the format of the Airborne Object Tracking data set
// (https://registry.opendata.aws/airborne-object-tracking): one flight with a list of entities, each an object in one
// frame, or a frame without objects.
//   time                     nanoseconds of the footage
//   blob                     frame: the footage's frame; range_distance_m: distance to the reference point
//   id                       category and number from 1, as Airplane1
//   bb                       left, top, width, height, in pixels from 0
//   labels.is_above_horizon  1 above, 0 on the horizon or unknown, -1 below
//   img_name                 image_name() in its folder, NAME/frame_000123.png, which differs from other flights' names
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

// Comma-separated values (RFC 4180: commas, quotes, CRLF): a row for each intruder and frame, visible or not, with the
// content and the digits of the SIGS XML file; fields of a box are empty where there is none.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_csv(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

// JSON Lines (https://jsonlines.org): everything that the SIGS annotation file has of a frame, on one line.
// JsonLinesStream writes the same to a stream.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_jsonl(const std::filesystem::path& path,
                                                              const LabelSequence& sequence);

// Positions are in metres, angles in degrees, boxes in pixels with the first pixel at 0, 0. Numbers have up to six
// digits after the point, those of an amodal box up to four.

// The truth of one frame as the element <frame> of a SIGS annotation file, indented, with a line break at its end.
[[nodiscard]] std::string xml_of(const FrameTruth& truth);

// The truth of one frame as one JSON object on a line of its own, with its line break. Fields and numbers are those of
// the element <frame> of a SIGS annotation file; docs/label-formats.md lists them.
[[nodiscard]] std::string json_line_of(const FrameTruth& truth, const LabelSequence& sequence);

// Writes each line to a stream at once, for programs that read while the frames are made. open_jsonl()
// (labels/formats.h) writes the same to a file.
class JsonLinesStream : public LabelWriter {
 public:
  JsonLinesStream(OutputStream out, LabelSequence sequence) : out_(std::move(out)), sequence_(std::move(sequence)) {}

  // Errors: write_failed (also where the reader has closed its end), interrupted.
  [[nodiscard]] Result<void> write(const FrameTruth& truth) override {
    return out_.write(json_line_of(truth, sequence_));
  }
  [[nodiscard]] Result<void> finish(const std::filesystem::path& /*images*/) override { return out_.close(); }

 private:
  OutputStream out_;
  LabelSequence sequence_;
};

}  // namespace sigs
