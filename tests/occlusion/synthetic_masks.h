// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

namespace sigs::test {

// A mask drawn as characters, one string a row, all of one length: '#' is 255, all else 0.
[[nodiscard]] cv::Mat drawn(std::initializer_list<std::string_view> rows);

// A mask in which each pixel is 255 by this chance.
[[nodiscard]] cv::Mat sprinkled(cv::Size size_px, double share, std::uint64_t seed);

// Smooth hills and valleys of all grey values, CV_8UC1.
[[nodiscard]] cv::Mat hills(cv::Size size_px, double width_px, std::uint64_t seed);

[[nodiscard]] bool same_bytes(const cv::Mat& a, const cv::Mat& b);

// The sizes on which a step must agree with its brute-force reference: a single pixel, lines, small images.
[[nodiscard]] std::vector<cv::Size> small_sizes();

}  // namespace sigs::test
