// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sigs::flights {

// Synthetic footage of a flight with the carrying aircraft in view, and its ground truth.
struct Flight {
  std::string name;  // "tail boom"
  cv::Size size_px;
  cv::Mat own_body;                 // truth, CV_8UC1: 255 where the body hides the world, 0 elsewhere
  std::function<cv::Mat(int)> bgr;  // frame n (any n >= 0, by n alone), CV_8UC3; may be called by several threads
  bool is_decidable = true;         // false: nothing moves, so that the body cannot be determined
};

struct FlightSettings {
  cv::Size size_px{640, 480};
  int frames = 300;  // intended number; "plain sky first" shows the sky for half of them
};

// Every case that the detection has to solve. The terrain below is made once for all of them.
[[nodiscard]] std::vector<Flight> all(const FlightSettings& settings = {});

// Flights beyond the requirements on the detection; by_name does not know them.
[[nodiscard]] std::vector<Flight> hard(const FlightSettings& settings = {});

// Reflections that stay in the image (cases.h): those to which the confidence is fitted, and those to which nothing is.
[[nodiscard]] std::vector<Flight> reflecting(const FlightSettings& settings = {});
[[nodiscard]] std::vector<Flight> unseen(const FlightSettings& settings = {});

[[nodiscard]] std::vector<std::string> names();  // of all()

// One case; stops where there is none of that name.
[[nodiscard]] Flight by_name(std::string_view name, const FlightSettings& settings = {});

}  // namespace sigs::flights
