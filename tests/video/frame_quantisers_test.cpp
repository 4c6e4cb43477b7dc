// SPDX-License-Identifier: MIT
#include "video/frame_quantisers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

FrameSource opened_with_quantisers(const std::filesystem::path& path) {
  Result<FrameSource> source = FrameSource::open(path, nullptr, Quantisers::read);
  REQUIRE(source.has_value());
  return std::move(*source);
}

// Whether every macroblock of every frame has this quantiser, and the mean is the same.
void check_all_are(FrameSource& source, double wanted) {
  for (int n = 0; n < source.info().frame_count(); ++n) {
    CAPTURE(n);
    const Result<Frame> frame = source.read(n);
    REQUIRE(frame.has_value());
    REQUIRE(frame->quantisers != nullptr);
    CHECK(frame->quantisers->mean == doctest::Approx(wanted).epsilon(1e-12));
    CHECK(cv::norm(frame->quantisers->blocks, cv::Mat(frame->quantisers->blocks.size(), CV_16SC1, cv::Scalar(wanted)),
                   cv::NORM_INF) == 0);
  }
}

// A pattern in which each macroblock differs from its neighbours in activity, so that x264's adaptive quantisation
// gives them different QPs.
const char* const kUneven = "testsrc2=size=120x88:rate=25:duration=1";

}  // namespace

TEST_CASE("the quantisers of H.264 footage are those that its encoder was told, in every macroblock of every picture") {
  const TemporaryFolder folder;
  for (const int qp : {7, 20, 33, 46})
    for (const char* format : {"yuv420p", "yuv422p", "yuv444p", "gray", "yuv420p10le"}) {
      CAPTURE(qp);
      CAPTURE(std::string(format));
      // Equal ratios: I, P and B pictures then have the same QP.
      if (!make_clip(fmt::format("-c:v libx264 -qp {} -i_qfactor 1 -b_qfactor 1 -x264-params aq-mode=0:mbtree=0:"
                                 "ipratio=1:pbratio=1 -pix_fmt {}",
                                 qp, format),
                     folder / "a.mkv", "testsrc2=size=128x96:rate=25:duration=0.6"))
        return;
      FrameSource source = opened_with_quantisers(folder / "a.mkv");
      // x264 counts QPs of 10 bits from 0, H.264 from -12, where the step is that of 8 bits at QP 0.
      check_all_are(source, std::string(format) == "yuv420p10le" ? qp - 12 : qp);
    }
}

TEST_CASE("pictures of a stream are told apart by type, and B pictures are coarser by x264's own ratio") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -qp 26 -bf 2 -x264-params aq-mode=0:b-adapt=0:b-pyramid=none:mbtree=0",
                 folder / "a.mkv"))
    return;
  FrameSource source = opened_with_quantisers(folder / "a.mkv");
  CHECK(source.read(0)->quantisers->type == PictureType::intra);
  CHECK(source.read(0)->quantisers->mean == 23);  // 26 - 6 log2(1.41), the default ratio
  CHECK(source.read(1)->quantisers->type == PictureType::bidirectional);
  CHECK(source.read(1)->quantisers->mean == 28);  // 26 + 6 log2(1.25)
  CHECK(source.read(3)->quantisers->type == PictureType::predicted);
  CHECK(source.read(3)->quantisers->mean == 26);
}

TEST_CASE("MPEG-2's and MPEG-4's quantiser scale is found, as a step in code values") {
  const TemporaryFolder folder;
  for (const char* codec : {"mpeg4", "mpeg2video", "mpeg1video"})
    for (const int scale : {2, 5, 13}) {
      CAPTURE(std::string(codec));
      CAPTURE(scale);
      if (!make_clip(fmt::format("-c:v {} -qscale:v {} -g 5", codec, scale), folder / "a.mkv",
                     "testsrc2=size=128x96:rate=25:duration=0.4"))
        return;
      FrameSource source = opened_with_quantisers(folder / "a.mkv");
      check_all_are(source, 2 * scale);
    }
}

TEST_CASE("JPEG's tables are those of the file: OpenCV's quality, to the last step") {
  const TemporaryFolder folder;
  const cv::Mat image = bgr_of(test_frame(PixelLayout::yuv444, {50, 40}, 1));
  for (const int quality : {5, 37, 50, 75, 92, 100}) {
    CAPTURE(quality);
    std::vector<uchar> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    CHECK(jpeg_tables_in(bytes.data(), bytes.size()) == jpeg_tables(quality));
    CHECK(jpeg_quality_percent(jpeg_tables(quality).luma) == quality);
    write_bytes(folder / "a.jpg", bytes);
    FrameSource source = opened_with_quantisers(folder / "a.jpg");
    const Result<Frame> frame = source.read(0);
    REQUIRE(frame.has_value());
    REQUIRE(frame->quantisers != nullptr);
    CHECK(frame->quantisers->kind == QuantiserKind::jpeg);
    CHECK(frame->quantisers->mean == quality);
    CHECK(frame->quantisers->tables == jpeg_tables(quality));
    // Cut off anywhere, it is no reading beyond the bytes that are there.
    for (std::size_t count = 0; count < std::min<std::size_t>(bytes.size(), 700); ++count) {
      const std::vector<uchar> head(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
      const JpegTables tables = jpeg_tables_in(head.data(), head.size());
      CHECK((tables.luma[0] == 0 || tables.luma == jpeg_tables(quality).luma));
    }
  }
}

TEST_CASE("the quantisers of a frame do not depend on what was read before, and the samples not on asking for them") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -crf 30 -g 8 -bf 2", folder / "a.mp4", kUneven)) return;
  FrameSource source = opened_with_quantisers(folder / "a.mp4");
  FrameSource plain = opened(folder / "a.mp4");
  std::vector<std::shared_ptr<const FrameQuantisers>> in_order;
  for (int n = 0; n < source.info().frame_count(); ++n) in_order.push_back(source.read(n)->quantisers);
  double low = 0;
  double high = 0;
  cv::minMaxLoc(in_order[0]->blocks, &low, &high);
  CHECK(low < high);
  FrameSource again = opened_with_quantisers(folder / "a.mp4");
  for (const int n : shuffled(again.info().frame_count())) {
    CAPTURE(n);
    const Result<Frame> frame = again.read(n);
    REQUIRE(frame.has_value());
    const Frame without = plain.read(n).value();
    CHECK(without.quantisers == nullptr);
    CHECK(samples_of(*frame) == samples_of(without));
    const std::size_t place = static_cast<std::size_t>(n);
    CHECK(frame->quantisers->type == in_order[place]->type);
    CHECK(cv::norm(frame->quantisers->blocks, in_order[place]->blocks, cv::NORM_INF) == 0);
  }
}

TEST_CASE("the map of a turned image is turned with it") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -crf 30 -g 8", folder / "flat.mp4", kUneven)) return;
  const Frame flat = opened_with_quantisers(folder / "flat.mp4").read(3).value();
  CHECK(flat.quantisers->blocks.size() == cv::Size(8, 6));
  for (const int degrees : {90, 180, 270}) {
    CAPTURE(degrees);
    REQUIRE(run_ffmpeg(fmt::format("-i \"{}\" -c copy -metadata:s:v:0 rotate={} \"{}\"", (folder / "flat.mp4").string(),
                                   degrees, (folder / "turned.mp4").string())));
    const Frame turned = opened_with_quantisers(folder / "turned.mp4").read(3).value();
    int fitting = 0;
    for (const auto& [rotation, origin] :
         {std::pair(cv::ROTATE_90_CLOCKWISE, cv::Point(-8, 0)), std::pair(cv::ROTATE_180, cv::Point(-8, -8)),
          std::pair(cv::ROTATE_90_COUNTERCLOCKWISE, cv::Point(0, -8))}) {
      cv::Mat samples;
      cv::rotate(flat.planes[0], samples, rotation);
      if (samples.size() != turned.size_px() || cv::norm(samples, turned.planes[0], cv::NORM_INF) > 0) continue;
      ++fitting;
      cv::Mat blocks;
      cv::rotate(flat.quantisers->blocks, blocks, rotation);
      CHECK(cv::norm(turned.quantisers->blocks, blocks, cv::NORM_INF) == 0);
      CHECK(turned.quantisers->origin_px == origin);
    }
    CHECK(fitting == 1);
  }
}

TEST_CASE("lossless footage is known as such") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v ffv1", folder / "a.mkv", "testsrc2=size=64x48:rate=25:duration=0.2")) return;
  FrameSource source = opened_with_quantisers(folder / "a.mkv");
  CHECK(source.read(2)->quantisers->kind == QuantiserKind::none);
  for (const char* codec : {"ffv1", "png", "rawvideo", "huffyuv"}) CHECK(is_lossless_codec(codec));
  for (const char* codec : {"h264", "mjpeg", "vp9", "hevc", "no such codec"}) CHECK(!is_lossless_codec(codec));
  for (const char* codec : {"h264", "mpeg4", "mpeg2video", "mjpeg"}) CHECK(states_quantisers(codec));
  for (const char* codec : {"hevc", "av1", "ffv1", ""}) CHECK(!states_quantisers(codec));
}

TEST_CASE("a damaged frame has the quantisers of the frame that stands in for it") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -crf 28 -g 50 -bf 0", folder / "a.mp4", kUneven)) return;
  std::vector<uint8_t> bytes = bytes_of(folder / "a.mp4");
  const std::vector<PacketPlace> packets = packets_of(folder / "a.mp4");
  FrameSource intact = opened_with_quantisers(folder / "a.mp4");
  for (std::size_t i = packets[12].offset + 8; i < packets[12].offset + packets[12].size; ++i) bytes[i] = 0x55;
  write_bytes(folder / "b.mp4", bytes);
  FrameSource source = opened_with_quantisers(folder / "b.mp4");
  const Result<Frame> frame = source.read(15);
  REQUIRE(frame.has_value());
  CHECK(frame->damaged);
  REQUIRE(frame->quantisers != nullptr);
  CHECK(cv::norm(frame->quantisers->blocks, intact.read(11)->quantisers->blocks, cv::NORM_INF) == 0);
}

TEST_CASE("the quantisers of a part are those that the whole has at its pixels") {
  auto whole = std::make_shared<FrameQuantisers>();
  whole->blocks.create(5, 7, CV_16SC1);
  for (int i = 0; i < 35; ++i) whole->blocks.at<short>(i / 7, i % 7) = static_cast<short>(i);
  whole->origin_px = {-6, -15};
  const auto at_pixel = [](const FrameQuantisers& quantisers, int x, int y) {
    return quantisers.at((x - quantisers.origin_px.x) / 16, (y - quantisers.origin_px.y) / 16);
  };
  for (const cv::Rect part : {cv::Rect(0, 0, 106, 65), cv::Rect(0, 0, 1, 1), cv::Rect(9, 0, 3, 3),
                              cv::Rect(10, 1, 64, 32), cv::Rect(50, 31, 56, 34), cv::Rect(105, 64, 1, 1)}) {
    const auto here = part_of(whole, part);
    CHECK(here->origin_px.x <= 0);
    CHECK(here->origin_px.x > -16);
    CHECK(here->origin_px.y <= 0);
    CHECK(here->origin_px.y > -16);
    int wrong = 0;
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x)
        wrong += at_pixel(*here, x, y) != at_pixel(*whole, part.x + x, part.y + y) ? 1 : 0;
    CHECK(wrong == 0);
  }
  CHECK(part_of(std::shared_ptr<const FrameQuantisers>(), cv::Rect(0, 0, 4, 4)) == nullptr);
}
