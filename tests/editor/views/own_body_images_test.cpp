// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_images.h"

#include <doctest/doctest.h>

using namespace sigs;
using namespace sigs::editor;

namespace {

cv::Vec3b color_at(int confidence) {
  return confidence_image(cv::Mat(1, 1, CV_16UC1, cv::Scalar(confidence))).at<cv::Vec3b>(0, 0);
}

}  // namespace

TEST_CASE("confidence is blue for the world, grey where undecided, violet for the own body") {
  const cv::Vec3b world = color_at(0);
  const cv::Vec3b unknown = color_at(32768);
  const cv::Vec3b body = color_at(65535);
  CHECK(world[0] > world[2] + 60);  // blue over red
  CHECK(std::abs(unknown[0] - unknown[1]) < 4);
  CHECK(std::abs(unknown[1] - unknown[2]) < 4);
  CHECK(body[2] > body[1] + 60);                   // red over green
  for (int step = 0; step < 65535; step += 257) {  // no jumps
    const cv::Vec3b a = color_at(step);
    const cv::Vec3b b = color_at(step + 257);
    for (int channel = 0; channel < 3; ++channel) CHECK(std::abs(a[channel] - b[channel]) <= 3);
  }
  CHECK(confidence_image(cv::Mat()).empty());
}

TEST_CASE("the tint is as opaque as the mask says") {
  cv::Mat mask(1, 3, CV_8UC1);
  mask.at<uchar>(0, 0) = 0;
  mask.at<uchar>(0, 1) = 128;
  mask.at<uchar>(0, 2) = 255;
  const cv::Mat tint = tinted(mask);
  REQUIRE(tint.type() == CV_8UC4);
  CHECK(tint.at<cv::Vec4b>(0, 0)[3] == 0);
  CHECK(tint.at<cv::Vec4b>(0, 1)[3] == 64);
  CHECK(tint.at<cv::Vec4b>(0, 2)[3] == 128);
}

TEST_CASE("a result has a text of one line") {
  CHECK(result_text({.frames_used = 800, .converged = true, .share = 0.1234}) ==
        "Found in 800 frames, converged early");
  CHECK(result_text({.frames_used = 2, .share = 0.00456}) == "Found in 2 frames");
  CHECK(result_text({.frames_used = 1500}) == "No own body in 1500 frames");
  CHECK(share_text(0.1234) == "12.3 % of the image");
  CHECK(share_text(0.00456) == "0.46 % of the image");
  CHECK(share_text(0) == "0 % of the image");
}

TEST_CASE("a result has a warning where the engine warns, most is masked, or little footage was used") {
  CHECK(cautions_about({.share = 0.5}, 10).empty());
  CHECK(cautions_about({.share = 0}, 60).empty());
  const std::vector<std::string> all =
      cautions_about({.share = 0.501, .warnings = {{"clip.mp4", "3 damaged frames"}}}, 6.66);
  REQUIRE(all.size() == 3);
  CHECK(all[0] == "clip.mp4: 3 damaged frames");
  CHECK(all[1].starts_with("50.1 % of the image, more than half"));
  CHECK(all[2].starts_with("Only 6.7 s"));
  CHECK(cautions_about({}, 9.99).size() == 1);
}

TEST_CASE("progress is shown with the remaining time") {
  DetectionState state{.phase = JobPhase::running};
  CHECK(progress_text(state) == "opening the footage...");
  state.done = 120;
  state.total = 800;
  CHECK(progress_text(state) == "120 of 800 frames");
  state.left_s = 65.4;
  CHECK(progress_text(state) == "120 of 800 frames, 1:05 left");
  state.is_stopping = true;
  CHECK(progress_text(state) == "stopping...");
}

TEST_CASE("stages keep their order and have their number") {
  OwnBody found;
  found.stages = {{"sum", "Sum of differences", cv::Mat::zeros(4, 4, CV_8UC1)},
                  {"none", "Not made", cv::Mat()},
                  {"canny", "Edges", cv::Mat::zeros(4, 4, CV_8UC1)}};
  const std::vector<StageTile> tiles = stage_tiles(found);
  REQUIRE(tiles.size() == 2);
  CHECK(tiles[0].label == "1  Sum of differences");
  CHECK(tiles[1].label == "2  Edges");
  CHECK(tiles[1].image.data == found.stages[2].image.data);
}
