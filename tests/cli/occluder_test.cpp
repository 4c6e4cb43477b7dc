// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "cli/program.h"
#include "cli/tiny_project.h"
#include "occlusion/synthetic_clip.h"

using namespace sigs;
using sigs::test::Run;
using sigs::test::run_sigs;
using sigs::test::TinyProject;

TEST_CASE("an occluder is found in a project's footage and named by its share of the image") {
  const TinyProject tiny;
  const std::string mask = tiny.file("masks/near.png").string();
  // Land that slides by under a camera whose attitude does not change is parallax; the block that stays is not.
  test::write_flight(tiny.file("flight.mkv"), 20, {128, 96});
  const std::string command =
      "occluder " + tiny.project() + " --set footage.video=" + tiny.file("flight.mkv").string() +
      " --frame 10 --span 6 --out " + mask + " --overlay " + tiny.file("masks/look.png").string();
  const Run run = run_sigs(command);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.out == mask + "\n" + tiny.file("masks/look.png").string() + "\n");
  CHECK(run.err.find("occluder: ") != std::string::npos);
  CHECK(cv::imread(mask, cv::IMREAD_UNCHANGED).type() == CV_8UC1);
  const Run again = run_sigs(command);
  CHECK(again.status == 73);
  CHECK(again.err.find("--force") != std::string::npos);
}

TEST_CASE("an occluder needs a frame of the footage, and a distance needs the camera's way") {
  const TinyProject tiny;
  const Run beyond = run_sigs("occluder " + tiny.project() + " --frame 5000 --out " + tiny.file("m.png").string());
  CHECK(beyond.status == 64);
  CHECK(beyond.err.find("--frame") != std::string::npos);
  const Run still = run_sigs("occluder " + tiny.project() + " --set camera.speed_mps=0 --max-distance 100 --out " +
                             tiny.file("m.png").string());
  CHECK(still.status == 64);
  CHECK(still.err.find("--max-distance") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(tiny.file("m.png")));
}
