// SPDX-License-Identifier: MIT
#include "labels/labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_text.h"
#include "labels/label_writing.h"
#include "project/fields.h"
#include "project/project.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

// Everything that a format writes of a clip of one frame, by the files' names.
std::map<std::string, std::string> written(const LabelFormat& format, const LabelSequence& clip,
                                           const FrameTruth& frame) {
  const TemporaryFolder folder;
  write_labels(std::string(format.name), folder / "l", clip, {frame});
  return format.is_folder ? contents_of(folder / "l")
                          : std::map<std::string, std::string>{{"l", text_of(folder / "l")}};
}

}  // namespace

TEST_CASE("the formats that a project may ask for are those that can be written, in one order") {
  std::vector<std::string_view> names;
  for (const LabelFormat& format : label_formats()) names.push_back(format.name);
  CHECK_MESSAGE(names == std::vector<std::string_view>(kLabelNames.begin(), kLabelNames.end()),
                "kFormats of engine/labels/labels.cpp: "
                    << listed(names) << "; kLabelNames of engine/project/project.h: " << listed(kLabelNames));
}

TEST_CASE("a format is found by its name alone") {
  for (const LabelFormat& format : label_formats()) CHECK(label_format(format.name) == &format);
  CHECK(label_format("") == nullptr);
  CHECK(label_format("XML") == nullptr);
  CHECK(label_format("xml,mot") == nullptr);
}

TEST_CASE("no two outputs have the same name: formats, the video and its masks") {
  std::set<std::string_view> suffixes{"", ".mkv", ".mp4", ".avi", ".masks", ".masks.mkv"};
  for (const LabelFormat& format : label_formats()) CHECK_MESSAGE(suffixes.insert(format.suffix).second, format.name);
}

TEST_CASE("an intruder is labelled where it meets both thresholds") {
  const IntruderTruth truth = visible_intruder(0, {1, 1, 3, 2});
  CHECK(is_labelled(truth, {}));
  CHECK(is_labelled(truth, {.min_pixels = 6, .min_visible_fraction = 1}));
  CHECK_FALSE(is_labelled(truth, {.min_pixels = 7}));
  IntruderTruth half = truth;
  half.visible_fraction = 0.5;
  CHECK(is_labelled(half, {.min_visible_fraction = 0.5}));
  CHECK_FALSE(is_labelled(half, {.min_visible_fraction = 0.500001}));
  CHECK_FALSE(is_labelled(invisible_intruder(0), {.min_pixels = 0}));
}

TEST_CASE("images are numbered as the footage is, in six digits or more") {
  CHECK(image_name(0) == "frame_000000.png");
  CHECK(image_name(123) == "frame_000123.png");
  CHECK(image_name(std::numeric_limits<int>::max()) == "frame_2147483647.png");
}

TEST_CASE("every format writes a clip without any intruder and one of a single frame") {
  for (const LabelFormat& format : label_formats()) {
    const TemporaryFolder folder;
    write_labels(std::string(format.name), folder / "none", synthetic_sequence(0, 1, {}),
                 {frame_of(0, {}), frame_of(1, {})});
    write_labels(std::string(format.name), folder / "one", synthetic_sequence(5, 5, {"airplane"}),
                 {frame_of(5, {invisible_intruder(0)})});
    CHECK(std::filesystem::exists(folder / "one"));
  }
}

namespace {

void check_settings_change_files(const LabelSequence& changed, const FrameTruth& frame, bool LabelFormat::*flag) {
  const LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  for (const LabelFormat& format : label_formats()) {
    const bool differs = written(format, clip, frame) != written(format, changed, frame);
    CHECK_MESSAGE(differs == format.*flag, format.name << " in engine/labels/labels.cpp");
  }
}

}  // namespace

TEST_CASE("thresholds change a file exactly where its format says that it has them") {
  LabelSequence strict = synthetic_sequence(0, 0, {"airplane"});
  strict.thresholds = {.min_pixels = 7, .min_visible_fraction = 1};
  check_settings_change_files(strict, frame_of(0, {visible_intruder(0, {1, 1, 3, 2})}), &LabelFormat::has_thresholds);
}

TEST_CASE("boxes are widened exactly where their format says so") {
  LabelSequence wider = synthetic_sequence(0, 0, {"airplane"});
  wider.box_scale = 1.5;
  check_settings_change_files(wider, frame_of(0, {visible_intruder(0, {100, 100, 30, 20})}),
                              &LabelFormat::widens_boxes);
}

TEST_CASE("own body and real aircraft are regions to ignore exactly where their format says so") {
  const FrameTruth frame = frame_of(0, {visible_intruder(0, {100, 100, 30, 20})});
  const LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  LabelSequence with_body = clip;
  with_body.own_body = cv::Mat::zeros(clip.footage.size_px, CV_32FC1);
  with_body.own_body.rowRange(400, 480).setTo(1);
  LabelSequence with_real_aircraft = clip;
  with_real_aircraft.has_real_aircraft = true;
  FrameTruth with_box = frame;
  with_box.real_aircraft = {{300, 50, 9, 5}};
  for (const LabelFormat& format : label_formats()) {
    const std::map<std::string, std::string> without = written(format, clip, frame);
    CHECK_MESSAGE((written(format, with_body, frame) != without) == format.has_ignored_regions,
                  format.name << " in engine/labels/labels.cpp");
    CHECK_MESSAGE((written(format, with_real_aircraft, with_box) != without) == format.has_ignored_regions,
                  format.name << " in engine/labels/labels.cpp");
  }
}

TEST_CASE("the help of the boxes' scale names the formats whose boxes are widened") {
  Project project;
  for (const Field& field : fields_of(project)) {
    if (field.key != "export.label_box_scale") continue;
    const std::string_view formats = field.help.substr(0, field.help.find(':'));
    for (const LabelFormat& format : label_formats())
      CHECK_MESSAGE((formats.find(format.name) != std::string_view::npos) == format.widens_boxes,
                    format.name << ": widens_boxes in engine/labels/labels.cpp, " << field.key
                                << " in engine/project/fields.cpp");
  }
}

TEST_CASE("the help of the thresholds' settings names the formats that have none") {
  Project project;
  for (const Field& field : fields_of(project)) {
    if (!field.key.starts_with("export.label_min_")) continue;
    const std::string_view formats = field.help.substr(field.help.find(';') + 1);
    for (const LabelFormat& format : label_formats())
      CHECK_MESSAGE((formats.find(format.name) == std::string_view::npos) == format.has_thresholds,
                    format.name << ": has_thresholds in engine/labels/labels.cpp, " << field.key
                                << " in engine/project/fields.cpp");
  }
}

TEST_CASE("every format names the file that it cannot create") {
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / "file", "x", false).has_value());
  for (const LabelFormat& format : label_formats()) {
    const std::filesystem::path path = folder / "file" / ("l" + std::string(format.suffix));
    const Result<std::unique_ptr<LabelWriter>> writer = format.open(path, synthetic_sequence(0, 1, {"airplane"}));
    REQUIRE_MESSAGE(!writer.has_value(), format.name);
    CHECK(writer.error().kind == ErrorKind::cannot_create);
    CHECK_MESSAGE(writer.error().where.starts_with((folder / "file").string()), format.name);
  }
}

TEST_CASE("every format with images names the one that is missing") {
  for (const LabelFormat& format : label_formats()) {
    if (!format.is_folder) continue;
    const TemporaryFolder folder;
    const LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
    std::filesystem::create_directory(folder / "l");
    std::filesystem::create_directory(folder / "images");
    Result<std::unique_ptr<LabelWriter>> writer = format.open(folder / "l", clip);
    REQUIRE(writer.has_value());
    for (const int frame : {0, 1})
      REQUIRE((*writer)->write(frame_of(frame, {visible_intruder(0, {1, 1, 2, 2})})).has_value());
    const Result<void> finished = (*writer)->finish(folder / "images");
    REQUIRE_MESSAGE(!finished.has_value(), format.name);
    CHECK(finished.error().kind == ErrorKind::write_failed);
    CHECK(finished.error().text().find("frame_000000.png") != std::string::npos);
  }
}

TEST_CASE("every folder of labels has its images with the extension that they have") {
  for (const LabelFormat& format : label_formats()) {
    if (!format.is_folder) continue;
    const TemporaryFolder folder;
    LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
    clip.image_extension = ".jpg";
    write_synthetic_images(folder / "images", clip);
    write_labels(std::string(format.name), folder / "l", clip,
                 {frame_of(0, {visible_intruder(0, {1, 1, 2, 2})}), frame_of(1, {invisible_intruder(0)})},
                 folder / "images");
    const std::vector<std::string> files = files_below(folder / "l");
    CHECK_MESSAGE(std::ranges::count_if(files, [](const std::string& file) { return file.ends_with(".jpg"); }) == 2,
                  format.name);
    CHECK_MESSAGE(std::ranges::none_of(files, [](const std::string& file) { return file.ends_with(".png"); }),
                  format.name);
  }
}

}  // namespace sigs::test
