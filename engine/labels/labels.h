// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "truth/annotation.h"

namespace sigs {

// Labels of all frames of an export, in formats that trackers, detectors and annotation tools read.

// An intruder is left out of a frame's labels where less of it is visible. Formats without LabelFormat::has_thresholds
// leave nothing out.
struct LabelThresholds {
  int min_pixels = 1;               // IntruderTruth::visible_pixels
  double min_visible_fraction = 0;  // IntruderTruth::visible_fraction
};

// What is the same for all frames of one intruder.
struct LabelledIntruder {
  int id = 0;
  std::string name;
  std::string category;       // one of LabelSequence::categories
  glm::dvec3 low_m{0, 0, 0};  // bounds of the model in body axes, relative to the reference point
  glm::dvec3 high_m{0, 0, 0};
};

// Where one of several cameras of an aircraft sits (docs/rigs.md).
struct MountedCamera {
  std::string name;
  Pose<frame::Body, frame::Camera> body_from_camera;
};

// What is the same for all frames of one set of labels.
struct LabelSequence {
  std::string name;  // the project's; any text that can name a folder
  FootageTruth footage;
  std::vector<LabelledIntruder> intruders;  // by id
  std::vector<std::string> categories;      // a format's number of a category follows from its position here
  std::string video;                        // the exported video, beside the labels; empty: numbered images are written
  int channels = 3;                         // of an image: 3 in colour, 1 in grey
  std::string image_extension = ".png";     // of the numbered images
  std::string images;  // folder beside the labels for numbered images, which need not exist: frame_000123.png
  cv::Mat
      own_body;  // CV_32FC1 of the image's size, 1 where the own body hides everything, 0 where nothing; empty: none
  std::optional<Camera> camera;  // nullopt: not known, and formats leave out what follows from it
  LabelThresholds thresholds;
  double box_scale = 1;            // of labelled_box()
  int box_margin_px = 0;           // likewise
  bool has_real_aircraft = false;  // some frame's truth has FrameTruth::real_aircraft, which formats ignore as they can
  std::vector<std::string> volumes = {};      // of EncounterTruth, by name; empty: the truth has no encounters
  std::optional<MountedCamera> mounted = {};  // none: the project has one camera
};

// The intruder with this id, which must exist.
[[nodiscard]] const LabelledIntruder& labelled_intruder(const LabelSequence& sequence, int id);

// The category of the intruder with this id, which must exist, and its position in LabelSequence::categories, from 0.
[[nodiscard]] int category_index(const LabelSequence& sequence, int id);

// Whether a frame's labels contain an intruder: it has a visible box and meets both thresholds.
[[nodiscard]] bool is_labelled(const IntruderTruth& truth, const LabelThresholds& thresholds);

// The box that detectors are to learn: the visible one, box_scale times as wide and high about its middle and grown by
// box_margin_px on each side, within the image. The intruder must have a visible box.
[[nodiscard]] cv::Rect labelled_box(const IntruderTruth& truth, const LabelSequence& sequence);

// "frame_000123.png": the name of a frame's image in LabelSequence::images. The number is the footage's.
//   extension  LabelSequence::image_extension
[[nodiscard]] std::string image_name(int frame, std::string_view extension = ".png");

// One set of labels in one format, frame by frame in order.
class LabelWriter {
 public:
  virtual ~LabelWriter() = default;

  // Appends the next frame. Error write_failed.
  [[nodiscard]] virtual Result<void> write(const FrameTruth& truth) = 0;

  // Completes the files. Errors cannot_create, write_failed.
  //   images  folder with the finished image_name() of each frame written, for formats whose folder contains images;
  //           they are linked, or copied where links are not possible. Empty: there are none
  [[nodiscard]] virtual Result<void> finish(const std::filesystem::path& images) = 0;
};

// One of the formats, an entry of the table in labels.cpp.
struct LabelFormat {
  std::string_view name;    // "coco", as --labels takes it
  std::string_view suffix;  // of the file or folder, behind the project's name: ".coco.json"
  bool is_folder = false;   // else one file
  std::string_view help;    // one line

  // Begins a set of labels at path, which is an empty file, or an empty folder where is_folder. Error cannot_create.
  Result<std::unique_ptr<LabelWriter>> (*open)(const std::filesystem::path& path, const LabelSequence& sequence);

  // What its folder may contain: relative paths, * any part of a name, # a number. A later export replaces a folder
  // with these files and refuses one with any other.
  std::span<const std::string_view> files{};

  bool names_images = true;    // whether its readers look for numbered images, one for each frame
  bool has_thresholds = true;  // whether it leaves intruders out (is_labelled); else it contains all of them
  bool widens_boxes = false;   // whether its boxes are those of labelled_box(); else all of them are visible boxes
  bool has_ignored_regions = false;  // whether it marks the own body and real aircraft as regions to ignore
};

// All formats, in the order in which the help lists them.
[[nodiscard]] std::span<const LabelFormat> label_formats();

// The format of this name; nullptr: there is none.
[[nodiscard]] const LabelFormat* label_format(std::string_view name);

// The names of the formats that leave nothing out, in the same order, for texts about the thresholds.
[[nodiscard]] std::vector<std::string_view> names_without_thresholds();

}  // namespace sigs
