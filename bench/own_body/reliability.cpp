// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "own_body/finding.h"
#include "own_body/measures.h"

namespace sigs::bench {

namespace {

using flights::Flight;

constexpr int kBins = 10;      // of the confidence, tenths
constexpr int kBorder_px = 4;  // pixels nearer to the truth's border are left out: there a pixel is part body

struct Bins {
  std::array<double, kBins> pixels{};
  std::array<double, kBins> body{};
  std::array<double, kBins> confidence{};
};

// Each clip counts alike, whatever its size.
void count(const Finding& finding, const Clip& clip, Bins& bins) {
  cv::Mat inner, outer;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kBorder_px + 1, 2 * kBorder_px + 1});
  cv::erode(clip.own_body, inner, disc);
  cv::dilate(clip.own_body, outer, disc);
  const cv::Mat& confidence = finding.body.confidence;
  const double share = 1.0 / double(confidence.total());
  for (int y = 0; y < confidence.rows; ++y)
    for (int x = 0; x < confidence.cols; ++x) {
      const bool is_body = inner.at<uchar>(y, x) != 0;
      if (!is_body && outer.at<uchar>(y, x) != 0) continue;
      const double value = confidence.at<std::uint16_t>(y, x) / 65535.0;
      const auto bin = static_cast<std::size_t>(std::min(kBins - 1, int(value * kBins)));
      bins.pixels[bin] += share;
      bins.body[bin] += is_body ? share : 0;
      bins.confidence[bin] += value * share;
    }
}

void measure(const std::string& set, const std::vector<Flight>& flights, int frames, const accuracy::Call& call,
             accuracy::Csv& table, accuracy::Csv& agreements) {
  Bins bins;
  for (const Flight& flight : flights) {
    if (!flight.is_decidable) continue;
    const Clip clip = encoded_clip(flight, frames, call.folder);
    const Finding finding = found_in(clip, with_method(OwnBodyMethod::stable, frames));
    if (finding.cannot.empty()) count(finding, clip, bins);
    std::string name = flight.name;
    std::ranges::replace(name, ',', ';');
    agreements.row(set, name, agreement(finding, clip), finding.cannot.empty() ? "mask" : "cannot tell");
    std::printf("%-8s %-28s %.3f %s\n", set.c_str(), name.c_str(), agreement(finding, clip), finding.cannot.c_str());
    std::fflush(stdout);
    const cv::Mat mask = finding.cannot.empty() ? finding.body.mask : cv::Mat(cv::Mat::zeros(flight.size_px, CV_8UC1));
    write_image(call.folder / "reliability" / (name + ".jpg"), overlay(flight.bgr(frames - 1), mask, clip.own_body));
    std::filesystem::remove(clip.path);
  }
  for (std::size_t bin = 0; bin < kBins; ++bin)
    table.row(set, double(bin) / kBins, bins.pixels[bin], bins.body[bin], bins.confidence[bin]);
}

}  // namespace

void measure_reliability(const accuracy::Call& call) {
  accuracy::Csv table(call.folder / "reliability.csv", "set,from,pixels,body,confidence");
  accuracy::Csv agreements(call.folder / "reflections.csv", "set,flight,iou,said");
  const flights::FlightSettings making{.size_px = call.quick ? cv::Size(320, 240) : cv::Size(640, 480),
                                       .frames = call.quick ? 60 : 250};
  std::vector<Flight> known = flights::all(making);
  for (const std::vector<Flight>& more : {flights::hard(making), flights::reflecting(making)})
    known.insert(known.end(), more.begin(), more.end());
  measure("unseen", flights::unseen(making), making.frames, call, table, agreements);
  if (!call.quick) measure("known", known, making.frames, call, table, agreements);
}

}  // namespace sigs::bench
