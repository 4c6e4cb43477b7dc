// SPDX-License-Identifier: MIT
#include "compositor/recompression.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// The same background each time, and with `contrast` a soft dark figure on it with thin lines, in all planes.
Frame figure_on_noise(PixelLayout layout, cv::Size size_px, double contrast) {
  Frame frame = blank_frame(layout, size_px, {});
  cv::RNG random(7);
  for (int i = 0; i < frame.plane_count(); ++i) {
    cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    cv::Mat values(plane.size(), CV_32FC1);
    random.fill(values, cv::RNG::NORMAL, 128, 40);
    cv::GaussianBlur(values, values, {}, 0.6);
    const cv::Point2d middle(plane.cols * 0.5, plane.rows * 0.45);
    for (int y = 0; y < plane.rows; ++y)
      for (int x = 0; x < plane.cols; ++x) {
        const bool fuselage = std::abs(y - middle.y) < plane.rows * 0.03 && std::abs(x - middle.x) < plane.cols * 0.3;
        const bool wing = std::abs(x - middle.x) < plane.cols * 0.04 && std::abs(y - middle.y) < plane.rows * 0.3;
        if (fuselage || wing) values.at<float>(y, x) -= static_cast<float>(contrast * (i == 0 ? 1 : 0.4));
      }
    values.convertTo(plane, CV_8UC1);
  }
  return frame;
}

PatchCoding h264_coding(cv::Size size_px, int qp) {
  return {.quantisers = cv::Mat(size_px / 16, CV_16SC1, cv::Scalar(qp))};
}

std::vector<PatchCoding> all_codings(cv::Size size_px) {
  PatchCoding mpeg{.kind = QuantiserKind::mpeg, .quantisers = cv::Mat(size_px / 16, CV_16SC1, cv::Scalar(12))};
  PatchCoding jpeg{.kind = QuantiserKind::jpeg, .tables = jpeg_tables(60)};
  return {h264_coding(size_px, 30), mpeg, jpeg};
}

void append(std::vector<uint8_t>& bytes, const Frame& frame) {
  const Samples samples = samples_of(frame);
  bytes.insert(bytes.end(), samples.begin(), samples.end());
}

double difference_of(const Frame& a, const Frame& b, int plane) {
  return cv::norm(a.planes[static_cast<std::size_t>(plane)], b.planes[static_cast<std::size_t>(plane)]);
}

double share_of_different(const Frame& a, const Frame& b, int plane) {
  const cv::Mat differs = a.planes[static_cast<std::size_t>(plane)] != b.planes[static_cast<std::size_t>(plane)];
  return cv::countNonZero(differs) / static_cast<double>(differs.total());
}

const cv::Size kSky(160, 128);

// A sky that is a little uneven, and with `middle` a dark cross on it with a bright bar, soft by 0.6 px.
Frame sky_with_figure(PixelLayout layout, const cv::Point2d* middle) {
  Frame frame = blank_frame(layout, kSky, {});
  for (int i = 0; i < frame.plane_count(); ++i) {
    cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    const double step = static_cast<double>(kSky.width) / plane.cols;
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

// Of a figure that only adds to what is behind it.
cv::Mat none_of(const Frame& frame) {
  return cv::Mat::zeros(frame.size_px(), CV_8UC1);
}

// Brown ground of small patches, and with `middle` an opaque white disc on it, soft by 0.6 px.
Frame ground_with_disc(const cv::Point2d* middle, cv::Mat* opacity = nullptr) {
  Frame frame = blank_frame(PixelLayout::yuv420, kSky, {});
  constexpr std::array kGround{110.0, 112.0, 143.0}, kDisc{225.0, 128.0, 128.0};
  for (int i = 0; i < 3; ++i) {
    cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    const double step = static_cast<double>(kSky.width) / plane.cols;
    for (int y = 0; y < plane.rows; ++y)
      for (int x = 0; x < plane.cols; ++x) {
        const double u = (x + 0.5) * step - 0.5, v = (y + 0.5) * step - 0.5;
        const double patches = std::sin(0.41 * u + 0.2 * v) * std::sin(0.33 * v - 0.1 * u) + std::sin(0.13 * u) * 0.7;
        double value = kGround[static_cast<std::size_t>(i)] + (i == 0 ? 22 : i == 1 ? -5 : 6) * patches;
        if (middle != nullptr) {
          const double share = 0.5 * std::erfc((std::hypot(u - middle->x, v - middle->y) - 9) / 0.85);
          value += share * (kDisc[static_cast<std::size_t>(i)] - value);
          if (opacity != nullptr && i == 0) opacity->at<uchar>(y, x) = cv::saturate_cast<uchar>(255 * share);
        }
        plane.at<uchar>(y, x) = cv::saturate_cast<uchar>(value);
      }
  }
  return frame;
}

// The mean difference of a plane from that of the ground, beside the disc.
double mean_traces(const Frame& coded, const Frame& ground, cv::Point2d middle, int plane) {
  const cv::Mat& a = coded.planes[static_cast<std::size_t>(plane)];
  const cv::Mat& b = ground.planes[static_cast<std::size_t>(plane)];
  const double step = static_cast<double>(kSky.width) / a.cols;
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      const double beside = std::hypot((x + 0.5) * step - 0.5 - middle.x, (y + 0.5) * step - 0.5 - middle.y) - 9;
      if (beside < 3 || beside > 20) continue;
      sum += std::abs(a.at<uchar>(y, x) - b.at<uchar>(y, x));
      ++count;
    }
  return sum / count;
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
  for (int y = 0; y < kSky.height; ++y)
    for (int x = 0; x < kSky.width; ++x) {
      const double beside = std::max(std::abs(x - middle.x) - 11, std::abs(y - middle.y - 1) - 9);
      if (beside < 4 || beside > 24) continue;
      const double off = coded.planes[0].at<uchar>(y, x) - sky.planes[0].at<uchar>(y, x);
      sum += off * off;
      ++count;
    }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("what x264 and FFmpeg's decoder make of a picture predicted from the one before is reproduced") {
  const TemporaryFolder folder;
  const cv::Size size(192, 128);
  for (const auto& [layout, pixels] :
       {std::pair(PixelLayout::yuv420, "yuv420p"), std::pair(PixelLayout::yuv422, "yuv422p"),
        std::pair(PixelLayout::yuv444, "yuv444p")})
    for (const int qp : {18, 24, 31, 38}) {
      const std::string format = pixels;
      CAPTURE(format);
      CAPTURE(qp);
      const Frame with_intruder = figure_on_noise(layout, size, 14);
      std::vector<uint8_t> raw;
      append(raw, figure_on_noise(layout, size, 0));
      append(raw, with_intruder);
      write_bytes(folder / "raw", raw);
      // An encoder without shortcuts of its own: no search for motion, no smoothing of levels, no dropped ones.
      const std::string encoder = fmt::format(
          "qp={}:ipratio=4:aq-mode=0:mbtree=0:keyint=99:scenecut=0:bframes=0:ref=1:weightp=0:partitions=none:8x8dct=0:"
          "me=dia:merange=4:subme=0:trellis=0:psy=0:no-dct-decimate=1:no-fast-pskip=1:chroma-qp-offset=0",
          qp);
      if (!run_ffmpeg(fmt::format("-f rawvideo -pix_fmt {} -s 192x128 -i \"{}\" -c:v libx264 -x264-params {} \"{}\"",
                                  format, (folder / "raw").string(), encoder, (folder / "a.mkv").string())))
        return;
      Result<FrameSource> source = FrameSource::open(folder / "a.mkv", nullptr, Quantisers::read);
      REQUIRE(source.has_value());
      const Frame before = source->read(0).value();
      const Frame decoded = source->read(1).value();
      REQUIRE(decoded.quantisers != nullptr);
      CHECK(decoded.quantisers->mean == qp);
      const Frame ours = recompressed(with_intruder, before, h264_coding(size, qp));
      for (int plane = 0; plane < ours.plane_count(); ++plane) {
        CAPTURE(plane);
        // Where the rounding of x264's own table of steps falls the other way, a block differs by one level. The means
        // of 4:2:2's chroma are coded in another grouping.
        if (layout == PixelLayout::yuv422 && plane > 0)
          CHECK(difference_of(ours, decoded, plane) < 0.4 * difference_of(with_intruder, decoded, plane));
        else
          CHECK(share_of_different(ours, decoded, plane) < 0.01);
      }
    }
}

TEST_CASE("JPEG's own encoder and decoder give the same image but for the rounding of their transforms") {
  const cv::Size size(96, 80);
  for (const int quality : {20, 60, 90}) {
    CAPTURE(quality);
    const Frame patch = figure_on_noise(PixelLayout::gray, size, 60);
    std::vector<uchar> bytes;
    cv::imencode(".jpg", patch.planes[0], bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    const cv::Mat decoded = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
    Frame before = blank_frame(PixelLayout::gray, size, {});
    const PatchCoding coding{.kind = QuantiserKind::jpeg, .tables = jpeg_tables(quality)};
    const Frame ours = recompressed(patch, before, coding);
    // The library works in whole numbers, so that a coefficient at a tie falls either way: here and there a block
    // differs by one level. Against what compression costs this is little.
    const double lost = cv::norm(decoded, patch.planes[0]);
    CHECK(cv::norm(ours.planes[0], decoded) < 0.25 * lost);
    CHECK(cv::norm(ours.planes[0], patch.planes[0]) == doctest::Approx(lost).epsilon(0.02));
  }
}

TEST_CASE("the error of MPEG's quantiser is that of a step with a dead zone") {
  const cv::Size size(256, 256);
  Frame before = blank_frame(PixelLayout::gray, size, {});
  before.planes[0] = 128;
  Frame patch = cloned(before);
  cv::RNG random(3);
  cv::Mat noise(size, CV_32FC1);
  random.fill(noise, cv::RNG::NORMAL, 128, 30);
  noise.convertTo(patch.planes[0], CV_8UC1);
  for (const int step : {4, 10}) {
    CAPTURE(step);
    const PatchCoding coding{.kind = QuantiserKind::mpeg, .quantisers = cv::Mat(size / 16, CV_16SC1, cv::Scalar(step))};
    const Frame coded = recompressed(patch, before, coding);
    cv::Mat off;
    cv::subtract(coded.planes[0], patch.planes[0], off, cv::noArray(), CV_32F);
    // The transform is orthonormal, so the samples' mean squared error is the coefficients', which are normal too.
    double wanted = 1.0 / 12;  // the samples are rounded
    constexpr double kSlice = 0.01;
    for (double size_of = kSlice / 2; size_of < 180; size_of += kSlice) {
      const double density = std::exp(-size_of * size_of / 1800) / (30 * std::sqrt(2 * CV_PI));
      const double beyond = size_of - 1.25 * step;  // the dead zone; from there on intervals of a step each
      const double decoded = beyond < 0 ? 0 : (1.5 + std::floor(beyond / step)) * step;
      wanted += 2 * density * kSlice * (size_of - decoded) * (size_of - decoded);
    }
    CHECK(cv::mean(off.mul(off))[0] == doctest::Approx(wanted).epsilon(0.03));
  }
}

TEST_CASE("a patch without an intruder keeps its bits, whatever the codec, layout and size") {
  for (const PixelLayout layout : kLayouts)
    for (const cv::Size size : {cv::Size(16, 16), cv::Size(48, 16), cv::Size(512, 64)})
      for (const PatchCoding& coding : all_codings(size)) {
        const Frame patch = figure_on_noise(layout, size, 0);
        CHECK(samples_of(recompressed(patch, patch, coding)) == samples_of(patch));
      }
}

TEST_CASE("H.264's filter reaches two samples beyond the macroblocks that differ, the others nothing") {
  for (const PixelLayout layout : kLayouts)
    for (const PatchCoding& coding : all_codings({96, 96})) {
      CAPTURE(static_cast<int>(layout));
      CAPTURE(static_cast<int>(coding.kind));
      const Frame before = figure_on_noise(layout, {96, 96}, 0);
      Frame patch = cloned(before);
      for (int i = 0; i < patch.plane_count(); ++i) {  // the macroblock in row and column 2
        cv::Mat& plane = patch.planes[static_cast<std::size_t>(i)];
        const cv::Rect block(plane.cols / 3, plane.rows / 3, plane.cols / 6, plane.rows / 6);
        plane(block) -= 40;
      }
      const Frame coded = recompressed(patch, before, coding);
      for (int i = 0; i < patch.plane_count(); ++i) {
        const auto which = static_cast<std::size_t>(i);
        const cv::Mat& plane = coded.planes[which];
        const int margin = coding.kind == QuantiserKind::h264 ? 2 : 0;
        cv::Mat differs = plane != before.planes[which];
        differs(cv::Rect(plane.cols / 3 - margin, plane.rows / 3 - margin, plane.cols / 6 + 2 * margin,
                         plane.rows / 6 + 2 * margin)) = 0;
        CHECK(cv::countNonZero(differs) == 0);
      }
    }
}

TEST_CASE("a coarser quantiser costs more, and QP 0 costs next to nothing") {
  const cv::Size size(128, 128);
  const Frame before = figure_on_noise(PixelLayout::yuv420, size, 0);
  const Frame patch = figure_on_noise(PixelLayout::yuv420, size, 60);
  double last = -1;
  for (const int qp : {0, 10, 20, 28, 36, 44, 51}) {
    CAPTURE(qp);
    const double error = cv::norm(recompressed(patch, before, h264_coding(size, qp)).planes[0], patch.planes[0]) / 128;
    CHECK(error > last);
    last = error;
    if (qp == 0) CHECK(error < 0.5);
    // Step 2^((qp - 4) / 6); what is lost is at most the figure itself, and otherwise below the step's own noise.
    CHECK(error < std::exp2((qp - 4) / 6.0));
  }
}

TEST_CASE("the same patch gives the same bytes on every thread and after any other patch") {
  const cv::Size size(176, 144);
  const Frame before = figure_on_noise(PixelLayout::yuv420, size, 0);
  const Frame patch = figure_on_noise(PixelLayout::yuv420, size, 60);
  for (const PatchCoding& coding : all_codings(size)) {
    const Samples first = samples_of(recompressed(patch, before, coding));
    std::vector<Samples> others(4);
    std::vector<std::thread> threads;
    for (Samples& other : others)
      threads.emplace_back([&] {
        for (const int edge : {16, 64, 512}) {
          const cv::Size other_size(edge, edge);
          static_cast<void>(recompressed(figure_on_noise(PixelLayout::yuv444, other_size, 30),
                                         figure_on_noise(PixelLayout::yuv444, other_size, 0),
                                         all_codings(other_size)[0]));
        }
        other = samples_of(recompressed(patch, before, coding));
      });
    for (std::thread& thread : threads) thread.join();
    for (const Samples& other : others) CHECK(other == first);
  }
}

TEST_CASE("without images before, too far away, or by a codec that predicts none, a patch is coded once") {
  const cv::Point2d middle(80.3, 60.6);
  const Frame sky = sky_with_figure(PixelLayout::yuv420, nullptr);
  const Frame patch = sky_with_figure(PixelLayout::yuv420, &middle);
  const PatchCoding coding = h264_coding(kSky, 27);
  const Frame once = recompressed(patch, sky, coding);
  CHECK(same_bits(recompressed_after(patch, sky, coding, {}, none_of(sky)), once));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const cv::Point2d far_away : {cv::Point2d(60, 0), cv::Point2d(0, nan), cv::Point2d(-infinity, 0)})
    CHECK(same_bits(recompressed_after(patch, sky, coding, std::vector{far_away, cv::Point2d(1, 1)}, none_of(sky)),
                    once));
  const PatchCoding jpeg{.kind = QuantiserKind::jpeg, .tables = jpeg_tables(60)};
  CHECK(same_bits(recompressed_after(patch, sky, jpeg, std::vector{cv::Point2d(2, 1)}, none_of(sky)),
                  recompressed(patch, sky, jpeg)));
}

TEST_CASE("what stands still is as the first coding left it: the second one finds nothing above its dead zone") {
  const cv::Point2d middle(80.3, 60.6);
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv444, PixelLayout::rgb}) {
    const Frame sky = sky_with_figure(layout, nullptr);
    const Frame patch = sky_with_figure(layout, &middle);
    const PatchCoding coding = h264_coding(kSky, 14);  // nothing is filtered at so fine a quantiser
    const Frame once = recompressed(patch, sky, coding);
    const Frame often = recompressed_after(patch, sky, coding, std::vector(5, cv::Point2d(0, 0)), none_of(sky));
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
                                kSky.width, kSky.height, (folder / "raw").string(), encoder,
                                (folder / "a.mkv").string())))
      return;
    Result<FrameSource> source = FrameSource::open(folder / "a.mkv");
    REQUIRE(source.has_value());
    const Frame sky = source->read(0).value();
    const cv::Point2d last = middle_of(kBefore);
    const Frame patch = sky_with_figure(PixelLayout::yuv420, &last);
    const double encoders = traces(source->read(kBefore + 1).value(), sky, last);
    const double once = traces(recompressed(patch, sky, h264_coding(kSky, qp)), sky, last);
    const double carried =
        traces(recompressed_after(patch, sky, h264_coding(kSky, qp), earlier_px, none_of(sky)), sky, last);
    CAPTURE(once);
    CAPTURE(carried);
    CAPTURE(encoders);
    CHECK(carried > 1.5 * once);
    CHECK(carried > encoders / 1.7);
    CHECK(carried < encoders * 1.7);
  }
}

TEST_CASE("an opaque figure before textured ground leaves about the traces that x264 leaves") {
  const TemporaryFolder folder;
  constexpr int kBefore = 8;
  for (const int qp : {24, 28, 32}) {
    CAPTURE(qp);
    const auto middle_of = [&](int n) { return cv::Point2d(60 + 2.3 * n, 52 + 1.1 * n); };
    std::vector<uint8_t> raw;
    append(raw, ground_with_disc(nullptr));
    std::vector<cv::Point2d> earlier_px;
    for (int n = 0; n <= kBefore; ++n) {
      const cv::Point2d middle = middle_of(n);
      append(raw, ground_with_disc(&middle));
      if (n > 0) earlier_px.push_back(middle_of(kBefore - n) - middle_of(kBefore));
    }
    write_bytes(folder / "raw", raw);
    if (!run_ffmpeg(fmt::format("-f rawvideo -pix_fmt yuv420p -s {}x{} -i \"{}\" -c:v libx264 -x264-params "
                                "qp={}:ipratio=4:aq-mode=0:mbtree=0:keyint=99:scenecut=0:bframes=0 \"{}\"",
                                kSky.width, kSky.height, (folder / "raw").string(), qp, (folder / "a.mkv").string())))
      return;
    Result<FrameSource> source = FrameSource::open(folder / "a.mkv");
    REQUIRE(source.has_value());
    const Frame ground = source->read(0).value();
    const cv::Point2d last = middle_of(kBefore);
    cv::Mat opacity = cv::Mat::zeros(kSky, CV_8UC1);
    const Frame patch = ground_with_disc(&last, &opacity);
    const Frame encoders = source->read(kBefore + 1).value();
    const Frame carried = recompressed_after(patch, ground, h264_coding(kSky, qp), earlier_px, opacity);
    for (int plane = 0; plane < 3; ++plane) {
      CAPTURE(plane);
      const double theirs = mean_traces(encoders, ground, last, plane),
                   ours = mean_traces(carried, ground, last, plane);
      CHECK(ours < 1.7 * theirs + 0.5);
      CHECK(ours > theirs / 1.7 - 0.5);
    }
  }
}
