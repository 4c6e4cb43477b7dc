// SPDX-License-Identifier: MIT
#include "telemetry/track_report.h"

#include <doctest/doctest.h>

#include <string>

using namespace sigs;
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a report has each channel's number, times, rate, range, gaps and jumps of its clock") {
  Track track{.format = "CSV", .utc_at_zero_s = 951782400.5};  // 2000-02-29
  track.exposure_s.source = "SHUT";
  for (int i = 0; i < 100; ++i) {
    // 10 Hz; half a second is missing behind sample 49; the clock counts milliseconds in 32 bits.
    track.exposure_s.times_s.push_back(0.1 * i + (i >= 50 ? 0.5 : 0));
    track.exposure_s.own_times_s.push_back(4294960 + track.exposure_s.times_s.back() - (i >= 70 ? 4294967.296 : 0));
    track.exposure_s.values.push_back(0.001 * (i + 1));
  }
  const std::vector<ChannelReport> reports = track_report(track);
  REQUIRE(reports.size() == 1);
  const ChannelReport& report = reports[0];
  CHECK(report.name == "exposure_s");
  CHECK(report.count == 100);
  CHECK(report.last_s == doctest::Approx(10.4));
  CHECK(report.median_rate_hz == doctest::Approx(10));
  REQUIRE(report.gaps.size() == 1);
  CHECK(report.gaps[0].at_s == doctest::Approx(4.9));
  CHECK(report.gaps[0].length_s == doctest::Approx(0.6));
  REQUIRE(report.jumps.size() == 1);
  CHECK(report.jumps[0].at_s == doctest::Approx(7.5));
  CHECK(contains(report.jumps[0].what, "2^32 ms"));
  REQUIRE(report.ranges.size() == 1);
  CHECK(report.ranges[0].low == doctest::Approx(0.001));
  CHECK(report.ranges[0].high == doctest::Approx(0.1));
  const std::string text = track_report_text(track);
  CHECK(contains(text, "2000-02-29 00:00:00.500"));
  CHECK(contains(text, "gap: 0.600 s after 4.900 s"));
  CHECK(contains(track_report_text(track, 0), "1 more gaps"));
}

TEST_CASE("a plot has a part for each kind of quantity that is there, and none for an empty track") {
  Track track;
  CHECK(track_plot(track).empty());
  track.position.times_s = {0};
  track.position.values = {{47, 8, 400}};
  const cv::Mat one = track_plot(track);
  CHECK(one.cols > 1000);
  track.camera_rate_radps.times_s = {0, 1};
  track.camera_rate_radps.values = {glm::dvec3(0), glm::dvec3(1)};
  CHECK(track_plot(track).rows > one.rows);
}
