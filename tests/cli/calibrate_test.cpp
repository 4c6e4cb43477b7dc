// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/persistence.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/program.h"
#include "made_boards/board_cases.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const char* const kCharuco =
    " --board charuco --corners 8x6 --square-m 0.03 --marker-m 0.021 --dictionary DICT_4X4_50 ";

// Twelve images of a ChArUco board, numbered.
void write_board_images(const std::filesystem::path& folder) {
  const made::BoardCase one = made::board_case("pinhole-charuco");
  const made::BoardRenderer renderer(one.camera, one.board, 2);
  int number = 10;
  for (const cv::Mat& image : made::case_images(one, renderer, 6, 12))
    REQUIRE(cv::imwrite((folder / (std::to_string(number++) + ".png")).string(), image));
}

}  // namespace

TEST_CASE("images of a board give a calibration that OpenCV reads, with plot and JSON, the same bytes each time") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "images");
  write_board_images(folder / "images");
  const std::string call = "calibrate " + (folder / "images").string() + kCharuco;
  const auto outputs = [&](const std::string& name) {
    return "--out " + (folder / (name + ".xml")).string() + " --plot " + (folder / (name + ".png")).string() +
           " --json " + (folder / (name + ".json")).string();
  };
  const Run run = run_sigs(call + outputs("a"));
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "* "));
  cv::FileStorage file((folder / "a.xml").string(), cv::FileStorage::READ);
  cv::Mat matrix;
  file["camera_matrix"] >> matrix;
  const cv::Matx33d truth = made::board_case("pinhole-charuco").camera.matrix;
  CHECK(matrix.at<double>(0, 0) == doctest::Approx(truth(0, 0)).epsilon(0.003));
  CHECK(static_cast<int>(file["image_width"]) == 640);
  CHECK(run_sigs("info " + (folder / "a.xml").string()).status == 0);
  CHECK(json_of(folder / "a.json").at("views").size() <= 12);
  CHECK(text_of(folder / "a.png").substr(0, 8) == "\x89PNG\r\n\x1a\n");
  REQUIRE(run_sigs(call + outputs("b")).status == 0);
  for (const char* const extension : {".xml", ".json", ".png"})
    CHECK(text_of(folder / (std::string("a") + extension)) == text_of(folder / (std::string("b") + extension)));
  CHECK(run_sigs(call + outputs("a")).status == 73);
}

TEST_CASE("a board that is not there, and options that do not go together, are one line that says what to do") {
  const TemporaryFolder folder;
  write_board_images(folder.path());
  for (const int number : {13, 14, 15, 16, 17, 18, 19, 20, 21})
    std::filesystem::remove(folder / (std::to_string(number) + ".png"));
  const std::string in = "calibrate " + folder.path().string() + " --out " + (folder / "a.xml").string();
  const Run other =
      run_sigs(in + " --board charuco --corners 8x6 --square-m 0.03 --marker-m 0.02 --dictionary DICT_7X7_50");
  CHECK(other.status == 65);
  CHECK(has(other.err, "DICT_4X4"));
  const Run few = run_sigs(in + kCharuco);
  CHECK_FALSE(has(few.err, "no board"));
  for (const char* const wrong :
       {" --board chessboard --square-m 0.03", " --board chessboard --corners 9x6",
        " --board chessboard --corners 9 --square-m 0.03", " --board charuco --corners 8x6 --square-m 0.03",
        " --board chessboard --corners 9x6 --square-m 0.03 --marker-m 0.02",
        " --board charuco --corners 8x6 --square-m 0.03 --marker-m 0.04 --dictionary DICT_4X4_50"}) {
    const Run run = run_sigs(in + wrong);
    CHECK_MESSAGE(run.status == 64, wrong << run.err);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "b.xml"));
}
