// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "camera/lens.h"
#include "editor/views/own_body/own_body_session.h"
#include "project/json.h"
#include "support/test_data.h"

namespace sigs::editor {

namespace fs = std::filesystem;

inline const cv::Size kSize(40, 30);

inline cv::Mat disk(int x) {
  cv::Mat mask = cv::Mat::zeros(kSize, CV_8UC1);
  move_brush(mask, {6, 3}, {x, 15}, {x, 15});
  return mask;
}

inline bool is_same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

// Finds a disk at the place that the settings give.
inline Result<OwnBody> find_disk(const Project& project, const JobControl&) {
  return OwnBody{.mask = disk(project.own_body.frames), .frames_used = project.own_body.frames};
}

// A project without a window, and a user who works on its mask.
struct MaskFixture {
  test::TemporaryFolder folder;
  Document document;
  Edits edits;
  OwnBodySession session{edits, [] {}, find_disk};
  OpenedScene scene{
      .draft = {.scene = {.camera = {*Lens::make({LensModel::brown_conrady, 30, 30, 19.5, 14.5, {}}), kSize}}}};

  explicit MaskFixture(const std::string& mask = "") {
    Project project;
    project.file = folder / "flight.json";
    project.footage.video = "flight.mp4";
    project.footage.own_body_mask = mask;
    REQUIRE(write_project(project, project.file, true));
    document = Document(project);
    scene.draft.scene.footage.size_px = kSize;
  }

  // An update of the window: edits are applied, the scene is opened again, the mask is checked.
  void update() {
    document.apply(edits.take_edits());
    scene.revision = document.revision().number;
    session.follow(document, &scene);
  }

  // As the scene's files have it.
  void use_mask_of_scene(const cv::Mat& mask) {
    scene.draft.scene.own_body = cv::Mat();
    if (!mask.empty()) mask.convertTo(scene.draft.scene.own_body, CV_32F, 1.0 / 255);
  }

  void detect(int x) {
    document.apply(ChangeProject{"frames", [x](Project& p) { p.own_body.frames = x; }, {}});
    update();
    REQUIRE(session.start(document));
    for (int i = 0; i < 2000 && session.job().is_running(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    update();
  }

  void stroke(double x) {
    session.painting().begin_stroke({3, 1}, {x, 5});
    session.painting().end_stroke();
  }

  // Answers the file browser; whether it was asked.
  bool choose(const fs::path& path) {
    for (const Request& request : edits.take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) {
        wanted->chosen(path);
        return true;
      }
    return false;
  }
  fs::path proposed() {
    for (const Request& request : edits.take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) return wanted->start;
    return {};
  }
  std::string errors() {
    std::string text;
    for (const Request& request : edits.take_requests())
      if (const auto* message = std::get_if<ShowMessage>(&request); message != nullptr && message->is_error)
        text += message->text;
    return text;
  }
};

}  // namespace sigs::editor
