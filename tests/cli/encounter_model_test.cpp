// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "../encounter_model/small_model.h"
#include "base/input_file.h"
#include "cli/program.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("a model is described, and flights of it are written as CSV and drawn; a seed gives the same bytes") {
  const TemporaryFolder folder;
  const std::string file = (folder / "m.txt").string();
  write_file(file, text_of(small_model()));
  const std::string csv = (folder / "a.csv").string();
  const std::string plot = (folder / "a.png").string();
  const Run plain = run_sigs("encounter-model " + file);
  CHECK(plain.status == 0);
  CHECK(has(plain.out, "vertical rate, ft/min"));
  CHECK(has(plain.out, "-600 -100 100 600"));
  CHECK(has(plain.out, "1 of 5 configurations never counted"));
  CHECK(has(plain.out, "1 of 6 configurations never counted"));
  const std::string draw = "encounter-model " + file + " --samples 7 --duration 20 --seed 3";
  const Run run = run_sigs(draw + " --out " + csv + " --plot " + plot);
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "7 flights of 20 s with seed 3"));
  const std::string text = read_text(csv).value();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 7 * 21);
  CHECK(text.starts_with("track,time_s,north_m,east_m,up_m,heading_deg,speed_mps,"));
  CHECK(cv::imread(plot).cols == 1440);
  const std::string again = (folder / "b.csv").string();
  REQUIRE(run_sigs(draw + " --out " + again).status == 0);
  CHECK(read_text(again).value() == text);
  REQUIRE(run_sigs("encounter-model " + file + " --samples 3 --duration 20 --seed 3 --force --out " + again).status ==
          0);
  CHECK(text.starts_with(read_text(again).value()));  // a flight does not depend on how many there are
  REQUIRE(run_sigs("encounter-model " + file + " --samples 7 --duration 20 --seed 4 --force --out " + again).status ==
          0);
  CHECK(read_text(again).value() != text);
}

TEST_CASE("what is no encounter model, and outputs that cannot be, end with the status that says so") {
  const TemporaryFolder folder;
  const std::string file = (folder / "m.txt").string();
  const std::string csv = (folder / "a.csv").string();
  write_file(file, "nothing\n");
  const Run broken = run_sigs("encounter-model " + file + " --out " + csv);
  CHECK(broken.status == 65);
  CHECK(has(broken.err, "m.txt: line 1: "));
  CHECK_FALSE(std::filesystem::exists(csv));
  CHECK(run_sigs("encounter-model " + (folder / "none").string()).status == 66);
  CHECK(run_sigs("encounter-model").status == 64);
  write_file(file, text_of(small_model()));
  for (const char* const options : {" --samples 0", " --duration 0", " --duration 1e9", " --seed -1", " --plot a.svg"})
    CHECK_MESSAGE(run_sigs("encounter-model " + file + options).status == 64, options);
  CHECK(run_sigs("encounter-model " + file + " --out " + file + " --force").status == 73);
  CHECK(read_text(file).value() == text_of(small_model()));
  write_file(csv, "mine");
  CHECK(run_sigs("encounter-model " + file + " --out " + csv).status == 73);
  CHECK(read_text(csv).value() == "mine");
  CHECK(run_sigs("encounter-model " + file + " --out /dev/full").status == 73);
}
