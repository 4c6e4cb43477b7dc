// SPDX-License-Identifier: MIT
#include "video/recompression.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const cv::Size kSize(160, 128);

// A sky that is a little uneven, and with `middle` a dark cross on it with a bright bar, soft by 0.6 px.
Frame sky_with_figure(PixelLayout layout, const cv::Point2d* middle) {
  Frame frame = blank_frame(layout, kSize, {});
  for (int i = 0; i < frame.plane_count(); ++i) {
    cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    const double step = static_cast<double>(kSize.width) / plane.cols;
    for (int y = 0; y < plane.rows; ++y)
      for (int x = 0; x < plane.cols; ++x) {
        double value = (i == 0 ? 140 : 124) + 2 * std::sin(0.06 * x * step) + 2 * std::cos(0.05 * y * step);
        if (middle != nullptr) {
          const double dx = (x + 0.5) * step - 0.5 - middle->x, dy = (y + 0.5) * step - 0.5 - middle->y;
          const auto inside = [](double at, double half) { return 0.5 * std::erfc((std::abs(at) - half) / 0.85); };
          value -= (i == 0 ? 60 : 10) * inside(dx, 11) * inside(dy, 1.5);
          value += (i == 0 ? 70 : 8) * inside(dx + 3, 1.5) * inside(dy - 2, 7);
        }
        plane.at<uchar>(y, x) = cv::saturate_cast<uchar>(value);
      }
  }
  return frame;
}

PatchCoding h264_coding(int qp) {
  return {.quantisers = cv::Mat(kSize / 16, CV_16SC1, cv::Scalar(qp))};
}

bool same_bits(const Frame& a, const Frame& b) {
  for (int i = 0; i < a.plane_count(); ++i)
    if (cv::norm(a.planes[static_cast<std::size_t>(i)], b.planes[static_cast<std::size_t>(i)], cv::NORM_INF) != 0)
      return false;
  return true;
}

// Root of the mean square of what luma differs by from the sky, 4 to 24 px beside the figure.
double traces(const Frame& coded, const Frame& sky, cv::Point2d middle) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const double beside = std::max(std::abs(x - middle.x) - 11, std::abs(y - middle.y - 1) - 9);
      if (beside < 4 || beside > 24) continue;
      const double off = coded.planes[0].at<uchar>(y, x) - sky.planes[0].at<uchar>(y, x);
      sum += off * off;
      ++count;
    }
  return std::sqrt(sum / count);
}

void append(std::vector<uint8_t>& bytes, const Frame& frame) {
  const Samples samples = samples_of(frame);
  bytes.insert(bytes.end(), samples.begin(), samples.end());
}

}  // namespace

TEST_CASE("without images before, too far away, or by a codec that predicts none, a patch is coded once") {
  const cv::Point2d middle(80.3, 60.6);
  const Frame sky = sky_with_figure(PixelLayout::yuv420, nullptr);
  const Frame patch = sky_with_figure(PixelLayout::yuv420, &middle);
  const PatchCoding coding = h264_coding(27);
  const Frame once = recompressed(patch, sky, coding);
  CHECK(same_bits(recompressed_after(patch, sky, coding, {}), once));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const cv::Point2d far_away : {cv::Point2d(60, 0), cv::Point2d(0, nan), cv::Point2d(-infinity, 0)})
    CHECK(same_bits(recompressed_after(patch, sky, coding, std::vector{far_away, cv::Point2d(1, 1)}), once));
  const PatchCoding jpeg{.kind = QuantiserKind::jpeg, .tables = jpeg_tables(60)};
  CHECK(
      same_bits(recompressed_after(patch, sky, jpeg, std::vector{cv::Point2d(2, 1)}), recompressed(patch, sky, jpeg)));
}

TEST_CASE("what stands still is as the first coding left it: the second one finds nothing above its dead zone") {
  const cv::Point2d middle(80.3, 60.6);
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv444, PixelLayout::rgb}) {
    const Frame sky = sky_with_figure(layout, nullptr);
    const Frame patch = sky_with_figure(layout, &middle);
    const PatchCoding coding = h264_coding(14);  // nothing is filtered at so fine a quantiser
    const Frame once = recompressed(patch, sky, coding);
    const Frame often = recompressed_after(patch, sky, coding, std::vector(5, cv::Point2d(0, 0)));
    for (int i = 0; i < once.plane_count(); ++i) {
      const auto which = static_cast<std::size_t>(i);
      const cv::Mat differs = once.planes[which] != often.planes[which];
      CHECK(cv::countNonZero(differs) < 0.01 * static_cast<double>(differs.total()));
      CHECK(cv::norm(once.planes[which], often.planes[which], cv::NORM_INF) <= 2);
    }
  }
}

TEST_CASE("as x264 does, a moving figure leaves several times the traces beside it that a single coding leaves") {
  const TemporaryFolder folder;
  constexpr int kBefore = 8;
  for (const int qp : {24, 28, 32}) {
    CAPTURE(qp);
    const auto middle_of = [&](int n) { return cv::Point2d(66 + 1.37 * n, 52 + 0.83 * n); };
    std::vector<uint8_t> raw;
    append(raw, sky_with_figure(PixelLayout::yuv420, nullptr));
    std::vector<cv::Point2d> earlier_px;
    for (int n = 0; n <= kBefore; ++n) {
      const cv::Point2d middle = middle_of(n);
      append(raw, sky_with_figure(PixelLayout::yuv420, &middle));
      if (n > 0) earlier_px.push_back(middle_of(kBefore - n) - middle_of(kBefore));
    }
    write_bytes(folder / "raw", raw);
    const std::string encoder = fmt::format(
        "qp={}:ipratio=4:aq-mode=0:mbtree=0:keyint=99:scenecut=0:bframes=0:ref=1:weightp=0:partitions=none:8x8dct=0:"
        "me=umh:merange=16:subme=5:trellis=0:psy=0:no-fast-pskip=1:chroma-qp-offset=0",
        qp);
    if (!run_ffmpeg(fmt::format("-f rawvideo -pix_fmt yuv420p -s {}x{} -i \"{}\" -c:v libx264 -x264-params {} \"{}\"",
                                kSize.width, kSize.height, (folder / "raw").string(), encoder,
                                (folder / "a.mkv").string())))
      return;
    Result<FrameSource> source = FrameSource::open(folder / "a.mkv");
    REQUIRE(source.has_value());
    const Frame sky = source->read(0).value();
    const cv::Point2d last = middle_of(kBefore);
    const Frame patch = sky_with_figure(PixelLayout::yuv420, &last);
    const double encoders = traces(source->read(kBefore + 1).value(), sky, last);
    const double once = traces(recompressed(patch, sky, h264_coding(qp)), sky, last);
    const double carried = traces(recompressed_after(patch, sky, h264_coding(qp), earlier_px), sky, last);
    CAPTURE(once);
    CAPTURE(carried);
    CAPTURE(encoders);
    CHECK(carried > 1.5 * once);
    CHECK(carried > encoders / 1.7);
    CHECK(carried < encoders * 1.7);
  }
}
