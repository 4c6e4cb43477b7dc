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

#include "base/result.h"
#include "camera/camera.h"
#include "truth/annotation.h"

namespace sigs {

// An intruder is left out of a frame's labels where less of it can be seen. xml and csv leave nothing out.
struct LabelThresholds {
  int min_pixels = 1;               // IntruderTruth::visible_pixels
  double min_visible_fraction = 0;  // IntruderTruth::visible_fraction
};

struct LabelledIntruder {
  int id = 0;
  std::string name;
  std::string category;       // one of LabelSequence::categories
  glm::dvec3 low_m{0, 0, 0};  // bounds of the model in body axes, from the reference point
  glm::dvec3 high_m{0, 0, 0};
};

// What is the same for all frames of one set of labels.
struct LabelSequence {
  std::string name;  // the project's
  FootageTruth footage;
  std::vector<LabelledIntruder> intruders;  // by id
  std::vector<std::string> categories;      // a category's number in a format is its place here
  std::string video;                        // the exported video, beside the labels; empty: numbered images are written
  int channels = 3;                         // of an image: 3 colour, 1 grey
  std::string images;  // folder beside the labels where numbered images of it lie, or belong: frame_000123.png
  cv::Mat own_body;    // CV_32FC1 of the image's size, 1 where the own body hides everything; empty: none
  std::optional<Camera> camera;
  LabelThresholds thresholds;
};

// Whether an intruder is in this frame's labels.
[[nodiscard]] bool is_labelled(const IntruderTruth& truth, const LabelThresholds& thresholds);

// "frame_000123.png": what the image of a frame is called in LabelSequence::images. The number is the footage's.
[[nodiscard]] std::string image_name(int frame);

// One set of labels in one format, frame by frame in order.
class LabelWriter {
 public:
  virtual ~LabelWriter() = default;

  // Error write_failed.
  [[nodiscard]] virtual Result<void> write(const FrameTruth& truth) = 0;

  // Completes the files.
  //   images  folder that holds the finished image_name() of each frame written, for formats whose folder has
  //             images in it; empty: there are none. They are linked, or copied where that cannot be
  [[nodiscard]] virtual Result<void> finish(const std::filesystem::path& images) = 0;
};

struct LabelFormat {
  std::string_view name;    // "coco", as --labels takes it
  std::string_view suffix;  // the labels are called NAME + suffix: ".coco.json"
  bool is_folder = false;
  std::string_view help;  // one line

  // Begins a set of labels at path, which is an empty file, or an empty folder where is_folder. Error cannot_create.
  Result<std::unique_ptr<LabelWriter>> (*open)(const std::filesystem::path& path, const LabelSequence& sequence);

  // What its folder may hold: relative paths, * any part of a name, # a number. A later export replaces a folder of
  // these, and none that holds anything else.
  std::span<const std::string_view> files{};

  bool names_images = true;  // whether its readers look for numbered images, one a frame
};

// All of them, in the order in which help lists them.
[[nodiscard]] std::span<const LabelFormat> label_formats();

// nullptr: there is none of that name.
[[nodiscard]] const LabelFormat* label_format(std::string_view name);

}  // namespace sigs
