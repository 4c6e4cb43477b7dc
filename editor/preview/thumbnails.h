// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <thread>

#include "base/result.h"
#include "frame/composed_frame.h"
#include "mesh/mesh.h"
#include "render/renderer.h"

namespace sigs::editor {

// A composited frame of a project around one of its intruders, CV_8UC3, of that size: what a card on the start page
// shows. Where intruders cannot be composed, the middle frame of the footage.
[[nodiscard]] Result<cv::Mat> project_thumbnail(const std::filesystem::path& project, cv::Size size_px,
                                                ComposeContext& compose);

// A model by itself, as turntable_image() shows it, as large as the size allows, CV_8UC4: what a model is chosen by. A
// sample's axes are known, those of another file are judged by its shape (first_project/first_model.h).
[[nodiscard]] Result<cv::Mat> model_thumbnail(const std::filesystem::path& model, cv::Size size_px,
                                              ComposeContext& compose);

// Images of files, made one after the other on a thread of its own when they are first asked for, and kept.
class Thumbnails {
 public:
  using Make = std::function<Result<cv::Mat>(const std::filesystem::path&, cv::Size, ComposeContext&)>;

  // wake  called from that thread when one is ready
  // make  project_thumbnail or model_thumbnail
  Thumbnails(cv::Size size_px, std::function<void()> wake, Make make);
  ~Thumbnails();  // waits for the one at work
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  // Asks for the image and returns at once. Null: not there yet, or there is none to be had; while it rests, nothing is
  // asked for.
  [[nodiscard]] std::shared_ptr<const cv::Mat> of(const std::filesystem::path& file);

  // While it rests, nothing more is made, and what waits is dropped as if it had never been asked for: others need the
  // processor.
  void rest(bool rests);

 private:
  void work();

  cv::Size size_px_;
  std::function<void()> wake_;
  Make make_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<std::filesystem::path> queue_;
  // By file; null while it is made, and where it could not be.
  std::map<std::filesystem::path, std::shared_ptr<const cv::Mat>> images_;
  bool rests_ = false;
  bool stop_ = false;
  std::thread thread_;  // started when the first image is asked for
};

// A model by itself: seen three-quarters from the front and slightly above, turned by turn_rad about its vertical
// (positive to the right, as yaw), lit from the left above, filling the image whatever its size. At turn 0 its nose
// points towards the viewer and to the right. CV_8UC4, RGBA, straight alpha, display code values; 4 samples a pixel.
[[nodiscard]] Result<cv::Mat> turntable_image(const Mesh& mesh, double turn_rad, cv::Size size_px, Renderer& renderer);

// Where a direction in body axes (x nose, y right wing, z belly) ends in that image, in pixels: from the middle of
// the model's bounds, as long as the sphere around them is wide to one side.
[[nodiscard]] glm::dvec2 turntable_point_px(const glm::dvec3& direction_in_body, double turn_rad, cv::Size size_px);

// Premultiplied linear RGBA (CV_32FC4) as straight display RGBA (CV_8UC4). What is wholly transparent is black.
[[nodiscard]] cv::Mat straight_display(const cv::Mat& premultiplied);

}  // namespace sigs::editor
