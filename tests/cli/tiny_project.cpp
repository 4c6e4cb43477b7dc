// SPDX-License-Identifier: MIT
#include "cli/tiny_project.h"

#include <fstream>
#include <map>
#include <stdexcept>

#include "base/staged_outputs.h"
#include "support/test_data.h"
#include "video/video_writer.h"

namespace sigs::test {

namespace {

constexpr const char* kProject = R"({
  "sigs": 1, "name": "tiny",
  "footage": {"video": "clip.mkv", "calibration": "lens.xml"},
  "intruders": [{"name": "cube", "model": {"file": "cube.obj"},
    "trajectory": {"waypoints": [{"frame": 0, "position_m": [20, -3, -150]}, {"frame": 9, "position_m": [20, 3, -150]}]}}]
})";

constexpr const char* kLens = R"(<?xml version="1.0"?>
<opencv_storage>
<image_width>64</image_width><image_height>48</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
<data>60. 0. 31.5 0. 60. 23.5 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>1</rows><cols>5</cols><dt>d</dt>
<data>-0.1 0.01 0. 0. 0.</data></distortion_coefficients>
</opencv_storage>
)";

constexpr const char* kCube = R"(mtllib cube.mtl
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
usemtl paint
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

std::string lens_of(cv::Size size_px) {
  std::string text = kLens;
  const std::string width = std::to_string(size_px.width);
  const std::string height = std::to_string(size_px.height);
  text.replace(text.find("<image_width>64"), 15, "<image_width>" + width);
  text.replace(text.find("<image_height>48"), 16, "<image_height>" + height);
  return text;
}

void write_clip(const std::filesystem::path& path, int frames, cv::Size size_px) {
  const VideoFormat format{.codec = VideoCodec::ffv1, .container = Container::mkv, .size_px = size_px};
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) throw std::runtime_error(writer.error().text());
  const cv::Size half((size_px.width + 1) / 2, (size_px.height + 1) / 2);
  for (int n = 0; n < frames; ++n) {
    Frame frame{.layout = format.layout, .color = format.color};
    frame.planes = {cv::Mat(size_px, CV_8UC1, cv::Scalar(90 + n % 10)), cv::Mat(half, CV_8UC1, cv::Scalar(128)),
                    cv::Mat(half, CV_8UC1, cv::Scalar(128))};
    frame.time_s = n * 0.04;
    if (!writer->write(frame, n)) throw std::runtime_error("clip");
  }
  if (!writer->finish()) throw std::runtime_error("clip");
}

}  // namespace

TinyProject::TinyProject(int frames, cv::Size size_px) {
  write_clip(file("clip.mkv"), frames, size_px);
  write_file(file("p.json"), kProject);
  write_file(file("lens.xml"), lens_of(size_px));
  write_file(file("cube.obj"), kCube);
  write_file(file("cube.mtl"), "newmtl paint\nKd 0.8 0.2 0.2\n");
}

void TinyProject::change(const std::string& from, const std::string& to) {
  std::string text = read_text(file("p.json")).value();
  const std::size_t place = text.find(from);
  if (place == std::string::npos) throw std::runtime_error("not in the project: " + from);
  write_file(file("p.json"), text.replace(place, from.size(), to));
}

int TinyProject::files_out() const {
  if (!std::filesystem::exists(out())) return 0;
  const std::filesystem::directory_iterator files(out());
  return static_cast<int>(std::distance(begin(files), end(files)));
}

std::filesystem::path image_in_labels(std::string_view format, int frame, int first_frame, std::string_view extension) {
  const auto numbered = [extension](int number, std::size_t digits) {
    const std::string text = std::to_string(number);
    return std::string(digits - text.size(), '0').append(text).append(extension);
  };
  const int index = frame - first_frame;
  const std::map<std::string_view, std::string> images{{"mot", "tiny/img1/" + numbered(index + 1, 6)},
                                                       {"kitti", "image_02/tiny/" + numbered(index, 6)},
                                                       {"vot", "tiny/color/" + numbered(index + 1, 8)},
                                                       {"voc", "JPEGImages/frame_" + numbered(frame, 6)},
                                                       {"yolo", "images/tiny/frame_" + numbered(frame, 6)}};
  const auto found = images.find(format);
  return found == images.end() ? "" : found->second;
}

}  // namespace sigs::test
