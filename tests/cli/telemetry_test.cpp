// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "base/input_file.h"
#include "cli/program.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("a flight log is reported on stdout, its warnings on stderr, and written as CSV and as a drawing") {
  const TemporaryFolder folder;
  const std::string log = (folder / "log.csv").string();
  write_file(log, "time_s,vn_mps,ve_mps,vd_mps,lat,lon,alt,volts\n0,1,2,3,47,8,400,12\n1,1,2,3,47,8.001,401,12\n");
  const std::string csv = (folder / "out.csv").string();
  const std::string plot = (folder / "out.png").string();
  const Run run = run_sigs("telemetry " + log + " --out " + csv + " --plot " + plot);
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "velocity_ned_mps"));
  CHECK(has(run.err, "volts"));
  CHECK(std::filesystem::exists(plot));
  const Run again = run_sigs("telemetry " + csv);
  CHECK(again.status == 0);
  CHECK(again.out == run.out);
  CHECK(run_sigs("telemetry " + log + " --out " + csv).status == 73);
  CHECK(run_sigs("telemetry " + log + " --out " + csv + " --force").status == 0);
}

TEST_CASE("what is no flight log, and outputs that cannot be, end with the status that says so and write nothing") {
  const TemporaryFolder folder;
  const std::string text = (folder / "text.txt").string();
  const std::string csv = (folder / "out.csv").string();
  write_file(text, "nothing\n");
  CHECK(run_sigs("telemetry " + text + " --out " + csv).status == 65);
  CHECK_FALSE(std::filesystem::exists(csv));
  CHECK(run_sigs("telemetry " + (folder / "none").string()).status == 66);
  CHECK(run_sigs("telemetry").status == 64);
  CHECK(run_sigs("telemetry " + text + " --plot out.svg").status == 64);
  write_file(csv, "time_s,exposure_s\n0,0.01\n");
  CHECK(run_sigs("telemetry " + csv + " --out " + csv + " --force").status == 73);
  CHECK(read_text(csv).value() == "time_s,exposure_s\n0,0.01\n");
}
