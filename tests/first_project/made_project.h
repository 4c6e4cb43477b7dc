// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "first_project/first_project.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "support/test_data.h"

namespace sigs::test {

// Makes the project, opens it from its file, and checks what every first project must have.
inline FirstProject made_and_opened(const FirstProjectOptions& options, double min_share = 0.5) {
  const Result<FirstProject> made = make_first_project(options);
  REQUIRE_MESSAGE(made, (made ? "" : made.error().text()));
  const Result<ReadProject> read = read_project(made->project.file);
  REQUIRE(read);
  CHECK(read->warnings.empty());
  const Result<OpenedProject> opened = open_project(read->project, nullptr);
  REQUIRE_MESSAGE(opened, (opened ? "" : opened.error().text()));
  for (const Problem& issue : opened->scene.issues) CHECK_MESSAGE(false, issue.field << ": " << issue.what);
  const Visibility seen = estimated_visibilities(opened->scene, 1000).front();
  CHECK(seen.visible >= min_share * seen.frames_checked);
  CHECK(seen.largest_px <= 64);
  CHECK(seen.largest_px >= 12);
  return *made;
}

inline const FirstProjectNote& note_on(const FirstProject& made, const std::string& field) {
  for (const FirstProjectNote& note : made.notes)
    if (note.field == field) return note;
  FAIL("no note on " << field);
  std::abort();
}

// Grey images of a slope of brightness with white noise of a known standard deviation, in code values; larger than a
// thermal camera's.
inline std::filesystem::path noisy_images(const TemporaryFolder& folder, double sd) {
  const std::filesystem::path images = folder / "noisy";
  std::filesystem::create_directory(images);
  cv::RNG random(7);
  for (int n = 0; n < 12; ++n) {
    cv::Mat1f image(240, 660), noise(240, 660);
    random.fill(noise, cv::RNG::NORMAL, 0, sd);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) image(y, x) = 60 + 0.2F * static_cast<float>(x) + noise(y, x);
    cv::Mat codes;
    image.convertTo(codes, CV_8U);
    cv::imwrite((images / fmt::format("{:03}.png", n)).string(), codes);
  }
  return images;
}

}  // namespace sigs::test
