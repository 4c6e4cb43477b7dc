// SPDX-License-Identifier: MIT
#include <cstdio>

#include "own_body/finding.h"
#include "own_body/measures.h"

namespace sigs::bench {

namespace {

using flights::Flight;

double share_of(const cv::Mat& mask) {
  return mask.empty() ? 0 : double(cv::countNonZero(mask >= 128)) / double(mask.total());
}

void measure(const Flight& flight, int frames, const accuracy::Call& call, accuracy::Csv& table,
             const StableOwnBodySettings& stable = {}) {
  const Clip clip = encoded_clip(flight, frames, call.folder);
  for (const OwnBodyMethod method : {OwnBodyMethod::paper, OwnBodyMethod::stable}) {
    OwnBodySettings settings = with_method(method, frames);
    settings.stable = stable;
    const Finding finding = found_in(clip, settings);
    const double value = agreement(finding, clip);
    table.row(flight.name, flight.size_px.width, flight.size_px.height, name_of(method), value,
              100 * share_of(clip.own_body), 100 * share_of(finding.body.mask), clip.is_decidable ? "yes" : "no",
              finding.cannot.empty() ? "mask" : "cannot tell");
    std::printf("%-26s %4d  %-6s %.4f  %s\n", flight.name.c_str(), flight.size_px.width, name_of(method), value,
                finding.cannot.c_str());
    std::fflush(stdout);
    const std::string file = flight.name + " " + std::to_string(flight.size_px.width) + " " + name_of(method) + ".jpg";
    const cv::Mat mask = finding.cannot.empty() ? finding.body.mask : cv::Mat(cv::Mat::zeros(flight.size_px, CV_8UC1));
    write_image(call.folder / "flights" / file, overlay(flight.bgr(frames - 1), mask, clip.own_body));
  }
  std::filesystem::remove(clip.path);
}

constexpr const char* kStrongest = "trembles by 2 to 8 px";

flights::FlightSettings making_of(const accuracy::Call& call) {
  return {.size_px = call.quick ? cv::Size(320, 240) : cv::Size(640, 480), .frames = call.quick ? 100 : 300};
}

constexpr const char* kHeader = "flight,width,height,method,iou,truth_percent,found_percent,can_be_told,said";

}  // namespace

void measure_flights(const accuracy::Call& call) {
  accuracy::Csv table(call.folder / "flights.csv", kHeader);
  const flights::FlightSettings making = making_of(call);
  for (const Flight& flight : flights::all(making)) measure(flight, making.frames, call, table);
  if (call.quick) return;
  for (const char* name : {"nose", "two parts"})
    measure(flights::by_name(name, {.size_px = {1280, 960}, .frames = making.frames}), making.frames, call, table);
}

void measure_limits(const accuracy::Call& call) {
  accuracy::Csv table(call.folder / "limits.csv", kHeader);
  const flights::FlightSettings making = making_of(call);
  for (Flight flight : flights::hard(making)) {
    measure(flight, making.frames, call, table);
    if (flight.name != kStrongest) continue;
    flight.name += "; vibration_px 8";
    measure(flight, making.frames, call, table, {.vibration_px = 8});
  }
  for (const char* name : {"tail boom", "two parts", "plain sky first"}) {
    Flight small = flights::by_name(name, {.size_px = {320, 240}, .frames = making.frames});
    small.name += ", small";
    measure(small, making.frames, call, table);
  }
}

}  // namespace sigs::bench
