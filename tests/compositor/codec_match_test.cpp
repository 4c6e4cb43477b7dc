// SPDX-License-Identifier: MIT
#include "compositor/codec_match.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "compositor/synthetic_frames.h"

namespace sigs::test {
namespace {

// A frame with something dark in reach, and the mask that belongs to it.
struct Pasted {
  Frame footage;
  Frame frame;
  cv::Mat mask;
  cv::Rect reach;
};

Pasted pasted(const Sort& sort, cv::Size size_px, const cv::Rect& reach) {
  Pasted made{.footage = grainy(sort, size_px), .mask = cv::Mat::zeros(size_px, CV_8UC1), .reach = reach};
  made.frame = cloned(made.footage);
  made.mask(reach) = 200;
  for (int i = 0; i < made.frame.plane_count(); ++i) {
    const cv::Size step = i == 0 ? cv::Size(1, 1) : chroma_step(sort.layout);
    const cv::Point low(reach.x / step.width, reach.y / step.height);
    const cv::Point high((reach.br().x + step.width - 1) / step.width, (reach.br().y + step.height - 1) / step.height);
    cv::Mat part = made.frame.planes[static_cast<std::size_t>(i)](cv::Rect(low, high));
    part = part * 0.4 + 20;
  }
  return made;
}

FrameQuantisers h264(int qp) {
  return *matched_quantisers(CodecMatchChoice::h264, qp, nullptr);
}

std::vector<FrameQuantisers> all_codecs() {
  const FrameQuantisers mpeg{.kind = QuantiserKind::mpeg, .mean = 14};
  return {h264(30), *matched_quantisers(CodecMatchChoice::mjpeg, 60.0, nullptr),
          *matched_quantisers(CodecMatchChoice::footage, std::nullopt, &mpeg)};
}

int changed(const Frame& a, const Frame& b) {
  int count = 0;
  for (int i = 0; i < a.plane_count(); ++i)
    count += cv::countNonZero(a.planes[static_cast<std::size_t>(i)] != b.planes[static_cast<std::size_t>(i)]);
  return count;
}

// Samples of a plane that differ from the footage although the mask is 0 at all their pixels.
int unmarked(const Pasted& made, int plane) {
  const auto which = static_cast<std::size_t>(plane);
  const cv::Size step = plane == 0 ? cv::Size(1, 1) : chroma_step(made.frame.layout);
  int count = 0;
  for (int y = 0; y < made.frame.planes[which].rows; ++y)
    for (int x = 0; x < made.frame.planes[which].cols; ++x) {
      if (made.frame.planes[which].at<uchar>(y, x) == made.footage.planes[which].at<uchar>(y, x)) continue;
      const cv::Rect span(x * step.width, y * step.height, step.width, step.height);
      count += cv::countNonZero(made.mask(span & cv::Rect({0, 0}, made.mask.size()))) == 0 ? 1 : 0;
    }
  return count;
}

}  // namespace

TEST_CASE("the codec match keeps to the macroblocks of the intruder and two samples beside, and says all in the mask") {
  const cv::Size size(203, 157);
  for (const Sort& sort : all_sorts())
    for (const FrameQuantisers& codec : all_codecs())
      for (const cv::Rect& reach : {cv::Rect(70, 50, 60, 44), cv::Rect(0, 0, 17, 9), cv::Rect(180, 140, 23, 17),
                                    cv::Rect(202, 156, 1, 1), cv::Rect(0, 0, 203, 157)}) {
        CAPTURE(sort.name);
        CAPTURE(static_cast<int>(codec.kind));
        CAPTURE(reach);
        Pasted made = pasted(sort, size, reach);
        const Frame uncoded = cloned(made.frame);
        const CodecMatch match(made.footage, std::vector{reach}, codec);
        CHECK(match.apply(made.frame, made.mask, {}) > 0);
        if (reach.area() > 1) CHECK(changed(made.frame, uncoded) > 0);
        cv::Mat outside = made.frame.planes[0] != made.footage.planes[0];
        const cv::Point low(reach.x / 16 * 16 - 2, reach.y / 16 * 16 - 2);
        const cv::Point high((reach.br().x + 15) / 16 * 16 + 2, (reach.br().y + 15) / 16 * 16 + 2);
        outside(cv::Rect(low, high) & cv::Rect({0, 0}, size)) = 0;
        CHECK(cv::countNonZero(outside) == 0);
        for (int plane = 0; plane < made.frame.plane_count(); ++plane) CHECK(unmarked(made, plane) == 0);
        CHECK(cv::countNonZero(made.mask(reach) < 200) == 0);
      }
}

TEST_CASE("what the own body hides has the footage's bits") {
  const cv::Size size(160, 120);
  for (const Sort& sort : all_sorts())
    for (const FrameQuantisers& codec : all_codecs()) {
      CAPTURE(sort.name);
      const cv::Rect reach(50, 40, 60, 40);
      Pasted made = pasted(sort, size, reach);
      cv::Mat own_body = cv::Mat::zeros(size, CV_32FC1);
      const cv::Rect body(0, 60, size.width, 60);
      own_body(body) = 1;
      for (int i = 0; i < made.frame.plane_count(); ++i) {  // as occluded layers leave it
        const auto which = static_cast<std::size_t>(i);
        const int rows = made.frame.planes[which].rows;
        const cv::Range hidden(rows / 2, rows);
        made.footage.planes[which].rowRange(hidden).copyTo(made.frame.planes[which].rowRange(hidden));
      }
      made.mask(body) = 0;
      const CodecMatch match(made.footage, std::vector{reach}, codec);
      static_cast<void>(match.apply(made.frame, made.mask, own_body));
      for (int i = 0; i < made.frame.plane_count(); ++i) {
        const auto which = static_cast<std::size_t>(i);
        const int rows = made.frame.planes[which].rows;
        CHECK(cv::norm(made.frame.planes[which].rowRange(rows / 2, rows),
                       made.footage.planes[which].rowRange(rows / 2, rows), cv::NORM_INF) == 0);
      }
      CHECK(cv::countNonZero(made.mask(body)) == 0);
    }
}

TEST_CASE("intruders far apart, beside each other and over each other are coded as if each were alone") {
  const Sort sort = all_sorts()[1];
  const cv::Size size(320, 240);
  const std::vector<std::vector<cv::Rect>> pairs{{{16, 16, 30, 30}, {250, 180, 40, 40}},
                                                 {{16, 16, 30, 30}, {60, 20, 30, 30}},
                                                 {{16, 16, 50, 50}, {40, 40, 60, 60}, {90, 90, 40, 40}}};
  for (const std::vector<cv::Rect>& reaches : pairs) {
    Pasted made = pasted(sort, size, reaches[0]);
    for (const cv::Rect& reach : reaches) {
      made.frame.planes[0](reach) *= 0.7;
      made.mask(reach) = 100;
    }
    Frame whole = cloned(made.frame);
    cv::Mat whole_mask = made.mask.clone();
    static_cast<void>(
        CodecMatch(made.footage, std::vector{cv::Rect({0, 0}, size)}, h264(34)).apply(whole, whole_mask, {}));
    static_cast<void>(CodecMatch(made.footage, reaches, h264(34)).apply(made.frame, made.mask, {}));
    CHECK(changed(made.frame, whole) == 0);
    CHECK(cv::norm(made.mask, whole_mask, cv::NORM_INF) == 0);
  }
}

TEST_CASE("each macroblock is coded by its own quantiser, on the grid where the stream has it") {
  const Sort sort = all_sorts()[0];
  const cv::Size size(128, 96);
  const cv::Rect reach(20, 20, 80, 60);
  FrameQuantisers stated{.kind = QuantiserKind::h264, .mean = 30, .origin_px = {-8, -5}};
  stated.blocks = cv::Mat(7, 9, CV_16SC1, cv::Scalar(0));
  stated.blocks.at<short>(3, 4) = 48;  // pixels 56 to 71, 43 to 58
  Pasted made = pasted(sort, size, reach);
  const Frame uncoded = cloned(made.frame);
  const CodecMatch match(made.footage, std::vector{reach},
                         *matched_quantisers(CodecMatchChoice::footage, std::nullopt, &stated));
  static_cast<void>(match.apply(made.frame, made.mask, {}));
  cv::Mat off;
  cv::absdiff(made.frame.planes[0], uncoded.planes[0], off);
  const cv::Rect coarse(56, 43, 16, 16);
  CHECK(cv::mean(off(coarse))[0] > 5);
  off(cv::Rect(coarse.tl() - cv::Point(2, 2), coarse.br() + cv::Point(2, 2))) = 0;
  double most = 0;
  cv::minMaxLoc(off, nullptr, &most);
  CHECK(most <= 1);  // QP 0 has steps below one code value
}

TEST_CASE("which quantisers are taken: the project's before the stream's before a default") {
  FrameQuantisers stated{.kind = QuantiserKind::h264, .mean = 31, .blocks = cv::Mat(2, 2, CV_16SC1, cv::Scalar(31))};
  CHECK(matched_quantisers(CodecMatchChoice::footage, std::nullopt, &stated)->at(0, 0) == 31);
  CHECK(matched_quantisers(CodecMatchChoice::h264, std::nullopt, &stated)->at(0, 0) == 31);
  CHECK(matched_quantisers(CodecMatchChoice::footage, 40.0, &stated)->at(0, 0) == 40);
  CHECK(matched_quantisers(CodecMatchChoice::footage, std::nullopt, nullptr)->at(0, 0) == kDefaultQp);
  CHECK(matched_quantisers(CodecMatchChoice::mjpeg, std::nullopt, &stated)->tables ==
        jpeg_tables(kDefaultJpegQuality_percent));
  CHECK(matched_quantisers(CodecMatchChoice::mjpeg, 35.0, nullptr)->tables == jpeg_tables(35));
  const FrameQuantisers mpeg{.kind = QuantiserKind::mpeg, .mean = 10};
  CHECK(matched_quantisers(CodecMatchChoice::footage, std::nullopt, &mpeg)->at(0, 0) == 10);
  CHECK(matched_quantisers(CodecMatchChoice::footage, 4.0, &mpeg)->at(0, 0) == 8);
  CHECK(matched_quantisers(CodecMatchChoice::h264, std::nullopt, &mpeg)->at(0, 0) == kDefaultQp);
  const FrameQuantisers lossless{.kind = QuantiserKind::none};
  CHECK(!matched_quantisers(CodecMatchChoice::footage, std::nullopt, &lossless));
  CHECK(matched_quantisers(CodecMatchChoice::h264, 20.0, &lossless)->at(0, 0) == 20);
}

TEST_CASE("without anything composited nothing is done") {
  const Pasted made = pasted(all_sorts()[0], {64, 64}, {10, 10, 20, 20});
  Frame frame = cloned(made.footage);
  cv::Mat mask;
  CHECK(CodecMatch(made.footage, std::vector{made.reach}, h264(40)).apply(frame, mask, {}) == 0);
  CHECK(mask.empty());
  CHECK(changed(frame, made.footage) == 0);
}

}  // namespace sigs::test
