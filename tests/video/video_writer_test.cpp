// SPDX-License-Identifier: MIT
#include "video/video_writer.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

ColorInfo plain_color() {
  ColorInfo color;
  color.matrix_stated = color.range_stated = true;
  return color;
}

VideoFormat tagged_format(VideoCodec codec, Container container, PixelLayout layout, cv::Size size_px) {
  VideoFormat format;
  format.codec = codec;
  format.container = container;
  format.layout = layout;
  format.size_px = size_px;
  format.color = plain_color();
  return format;
}

double mean_difference(const Frame& a, const Frame& b) {
  return cv::norm(a.planes[0], b.planes[0], cv::NORM_L1) / static_cast<double>(a.planes[0].total());
}

}  // namespace

TEST_CASE("FFV1 gives back every sample of every layout and size") {
  for (const Container container : {Container::mkv, Container::avi})
    for (const PixelLayout layout : kLayouts)
      for (const cv::Size size : {cv::Size(160, 120), cv::Size(161, 99), cv::Size(7, 5), cv::Size(4, 4), cv::Size(5, 5),
                                  cv::Size(30, 4), cv::Size(4, 5)}) {
        CAPTURE(static_cast<int>(layout));
        CAPTURE(size);
        const TemporaryFolder folder;
        write_clip(folder / "a", tagged_format(VideoCodec::ffv1, container, layout, size), 5);
        FrameSource source = opened(folder / "a");
        REQUIRE(source.info().frame_count() == 5);
        CHECK(source.info().layout == layout);
        CHECK(source.info().size_px == size);
        CHECK(source.info().conversion.empty());
        for (const int n : {0, 1, 2, 3, 4, 2, 0}) {
          const Result<Frame> frame = source.read(n);
          REQUIRE(frame.has_value());
          CHECK(!frame->damaged);
          const bool same = samples_of(*frame) == samples_of(test_frame(layout, size, n));
          CHECK(same);
        }
      }
}

TEST_CASE("the lossy codecs keep a colour in every layout container range and matrix") {
  for (const VideoCodec codec : {VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1, VideoCodec::mjpeg})
    for (const Container container : {Container::mkv, Container::mp4, Container::avi})
      for (const PixelLayout layout : kLayouts)
        for (const auto& [range, matrix] :
             {std::pair{ColorRange::limited, ColorMatrix::bt709}, std::pair{ColorRange::full, ColorMatrix::bt601}}) {
          CAPTURE(static_cast<int>(codec));
          CAPTURE(static_cast<int>(container));
          CAPTURE(static_cast<int>(layout));
          const bool is_new = codec == VideoCodec::hevc || codec == VideoCodec::av1;
          if (is_new && container == Container::avi) continue;
          const TemporaryFolder folder;
          VideoFormat format = tagged_format(codec, container, layout, {96, 64});
          format.color.range = range;
          format.color.matrix = matrix;
          Frame frame = frame_of_bgr(cv::Mat(64, 96, CV_8UC3, cv::Scalar(30, 70, 220)), layout, format.color);
          const cv::Mat want = bgr_of(frame);
          Result<VideoWriter> writer = VideoWriter::open(folder / "a", format);
          REQUIRE(writer.has_value());
          for (int n = 0; n < 8; ++n) {
            frame.time_s = n / 25.0;
            REQUIRE(writer->write(frame, n).has_value());
          }
          REQUIRE(writer->finish().has_value());
          FrameSource source = opened(folder / "a");
          REQUIRE(source.info().frame_count() == 8);
          // Quantised by at most one code in luma and chroma, the latter times 2.1; a wrong range or matrix is off by
          // more than 10 in this colour.
          CHECK(cv::norm(want, bgr_of(*source.read(3)), cv::NORM_INF) <= 5);
          CHECK(source.info().times_s[3] == doctest::Approx(0.12).epsilon(0.01));
        }
}

TEST_CASE("H264 with crf 0 is lossless") {
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444}) {
    const TemporaryFolder folder;
    VideoFormat format = tagged_format(VideoCodec::h264, Container::mp4, layout, {96, 64});
    format.crf = 0;
    write_clip(folder / "a", format, 4);
    FrameSource source = opened(folder / "a");
    for (int n = 0; n < 4; ++n) CHECK(samples_of(*source.read(n)) == samples_of(test_frame(layout, {96, 64}, n)));
  }
}

TEST_CASE("the bytes depend on neither the run nor the threads") {
  for (const auto& output : {std::pair{VideoCodec::ffv1, Container::mkv}, std::pair{VideoCodec::ffv1, Container::avi},
                             std::pair{VideoCodec::h264, Container::mkv}, std::pair{VideoCodec::h264, Container::mp4},
                             std::pair{VideoCodec::hevc, Container::mkv}, std::pair{VideoCodec::hevc, Container::mp4},
                             std::pair{VideoCodec::av1, Container::mkv}, std::pair{VideoCodec::av1, Container::mp4},
                             std::pair{VideoCodec::mjpeg, Container::mkv}, std::pair{VideoCodec::mjpeg, Container::mp4},
                             std::pair{VideoCodec::mjpeg, Container::avi}}) {
    const VideoCodec codec = output.first;
    const Container container = output.second;
    CAPTURE(static_cast<int>(codec));
    CAPTURE(static_cast<int>(container));
    const TemporaryFolder folder;
    VideoFormat format = tagged_format(codec, container, PixelLayout::yuv420, {176, 144});
    std::vector<std::vector<uint8_t>> files;
    for (const int threads : {1, 1, 2, 4}) {
      format.threads = threads;
      write_clip(folder / "a", format, 24);
      files.push_back(bytes_of(folder / "a"));
    }
    REQUIRE(files[0].size() > 10000);
    for (const auto& file : files) {
      const bool same = file == files[0];
      CHECK(same);
    }
  }
}

TEST_CASE("colour range, matrix, primaries, transfer function and chroma site are preserved") {
  for (const auto& output : {std::pair{VideoCodec::ffv1, Container::mkv}, std::pair{VideoCodec::h264, Container::mkv},
                             std::pair{VideoCodec::h264, Container::mp4}, std::pair{VideoCodec::h264, Container::avi},
                             std::pair{VideoCodec::hevc, Container::mkv}, std::pair{VideoCodec::hevc, Container::mp4},
                             std::pair{VideoCodec::av1, Container::mkv}, std::pair{VideoCodec::av1, Container::mp4}})
    for (const ColorRange range : {ColorRange::limited, ColorRange::full})
      for (const ColorMatrix matrix : {ColorMatrix::bt601, ColorMatrix::bt709, ColorMatrix::bt2020})
        for (const ChromaSite site : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left}) {
          const VideoCodec codec = output.first;
          const Container container = output.second;
          CAPTURE(static_cast<int>(codec));
          CAPTURE(static_cast<int>(container));
          CAPTURE(static_cast<int>(site));
          // AV1's own header has no number for midway; Matroska has.
          if (codec == VideoCodec::av1 && container == Container::mp4 && site == ChromaSite::center) continue;
          const TemporaryFolder folder;
          VideoFormat format = tagged_format(codec, container, PixelLayout::yuv420, {64, 48});
          format.color.range = range;
          format.color.matrix = matrix;
          format.color.chroma_site = site;
          format.color.primaries = 9;
          format.color.transfer = 13;
          write_clip(folder / "a", format, 2);
          CHECK(opened(folder / "a").info().color == format.color);
        }
}

TEST_CASE("4:2:2 states its chroma site too: motion JPEG midway, video at the left") {
  const TemporaryFolder folder;
  for (const auto& output :
       {std::pair{VideoCodec::mjpeg, ChromaSite::center}, std::pair{VideoCodec::ffv1, ChromaSite::center},
        std::pair{VideoCodec::ffv1, ChromaSite::left}, std::pair{VideoCodec::h264, ChromaSite::left}}) {
    const VideoCodec codec = output.first;
    const ChromaSite site = output.second;
    CAPTURE(static_cast<int>(codec));
    VideoFormat format = tagged_format(codec, Container::mkv, PixelLayout::yuv422, {64, 48});
    format.color.chroma_site = site;
    write_clip(folder / "a", format, 2);
    CHECK(opened(folder / "a").info().color.chroma_site == site);
  }
}

TEST_CASE("a colour matrix that is not known is warned of, and the written file still states it") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v ffv1 -pix_fmt yuv420p -colorspace ycgco", folder / "a.mkv")) return;
  FrameSource source = opened(folder / "a.mkv");
  const VideoInfo& info = source.info();
  CHECK_FALSE(info.color.matrix_stated);
  CHECK(info.color.unknown_matrix == 8);  // YCgCo, ISO/IEC 23091-2
  CHECK_FALSE(info.warnings.empty());
  for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::h264}) {
    const VideoFormat format{.codec = codec, .size_px = info.size_px, .color = info.color};
    Result<VideoWriter> writer = VideoWriter::open(folder / "b.mkv", format);
    REQUIRE(writer.has_value());
    REQUIRE(writer->write(*source.read(0), 0).has_value());
    REQUIRE(writer->finish().has_value());
    CHECK(opened(folder / "b.mkv").info().color.unknown_matrix == 8);
    std::filesystem::remove(folder / "b.mkv");
  }
}

TEST_CASE("colours that the footage leaves unstated stay unstated") {
  for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1}) {
    CAPTURE(static_cast<int>(codec));
    const TemporaryFolder folder;
    VideoFormat format = tagged_format(codec, Container::mkv, PixelLayout::yuv420, {64, 48});
    format.color = {};
    format.color.matrix = ColorMatrix::bt601;
    write_clip(folder / "a", format, 2);
    const ColorInfo color = opened(folder / "a").info().color;
    CHECK(!color.matrix_stated);
    // The streams of HEVC and AV1 always state a range: limited where nothing else is known.
    format.color.range_stated = codec == VideoCodec::hevc || codec == VideoCodec::av1;
    CHECK(color == format.color);
  }
}

TEST_CASE("rate, pixel aspect and size are preserved") {
  for (const auto& output : {std::pair{VideoCodec::ffv1, Container::mkv}, std::pair{VideoCodec::h264, Container::mp4},
                             std::pair{VideoCodec::hevc, Container::mp4}, std::pair{VideoCodec::av1, Container::mp4},
                             std::pair{VideoCodec::mjpeg, Container::avi}})
    for (const auto& rate : {std::pair{30000, 1001}, std::pair{24000, 1001}, std::pair{25, 1}, std::pair{15, 2}}) {
      const VideoCodec codec = output.first;
      const Container container = output.second;
      CAPTURE(static_cast<int>(codec));
      const auto [num, den] = rate;
      CAPTURE(rate.first);
      const TemporaryFolder folder;
      VideoFormat format = tagged_format(codec, container, PixelLayout::yuv420, {64, 48});
      format.frame_rate_num = num;
      format.frame_rate_den = den;
      format.pixel_aspect_num = 4;
      format.pixel_aspect_den = 3;
      write_clip(folder / "a", format, 30);
      const FrameSource source = opened(folder / "a");
      CHECK(source.info().frame_rate_num == num);
      CHECK(source.info().frame_rate_den == den);
      CHECK(!source.info().variable_frame_rate);
      if (container != Container::avi) {  // AVI has no place for it
        CHECK(source.info().pixel_aspect_num == 4);
        CHECK(source.info().pixel_aspect_den == 3);
      }
      CHECK(source.info().warnings.empty());
    }
}

TEST_CASE("uneven frame times are preserved in Matroska and MP4 and begin at zero") {
  for (const auto& output :
       {std::pair{VideoCodec::ffv1, Container::mkv}, std::pair{VideoCodec::h264, Container::mkv},
        std::pair{VideoCodec::h264, Container::mp4}, std::pair{VideoCodec::hevc, Container::mkv},
        std::pair{VideoCodec::hevc, Container::mp4}, std::pair{VideoCodec::av1, Container::mkv},
        std::pair{VideoCodec::av1, Container::mp4}, std::pair{VideoCodec::mjpeg, Container::mp4}}) {
    const VideoCodec codec = output.first;
    const Container container = output.second;
    CAPTURE(static_cast<int>(codec));
    CAPTURE(static_cast<int>(container));
    const TemporaryFolder folder;
    const VideoFormat format = tagged_format(codec, container, PixelLayout::yuv420, {64, 48});
    Result<VideoWriter> writer = VideoWriter::open(folder / "a", format);
    REQUIRE(writer.has_value());
    const auto time_s = [](int n) { return 3.5 + 0.011 * n + 0.0013 * n * n; };
    for (int n = 0; n < 40; ++n) {
      Frame frame = test_frame(format.layout, format.size_px, n);
      frame.time_s = time_s(n);
      REQUIRE(writer->write(frame, n).has_value());
    }
    REQUIRE(writer->finish().has_value());
    FrameSource source = opened(folder / "a");
    REQUIRE(source.info().frame_count() == 40);
    CHECK(source.info().variable_frame_rate);
    const double tick_s = container == Container::mkv ? 1e-3 : 1.0 / 60000;
    for (int n = 0; n < 40; ++n)  // half a tick of rounding at either end
      CHECK(std::abs(source.info().times_s[static_cast<size_t>(n)] - (time_s(n) - time_s(0))) <= tick_s * 1.0001);
    const Frame read = *source.read(20);
    const auto distance_to = [&](int n) { return mean_difference(read, test_frame(format.layout, format.size_px, n)); };
    CHECK(distance_to(20) < distance_to(19));
    CHECK(distance_to(20) < distance_to(21));
  }
}

TEST_CASE("clips of one frame and of a few are whole, whatever the encoder holds back") {
  for (const VideoCodec codec : {VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1})
    for (const Container container : {Container::mp4, Container::mkv})
      for (const int frames : {1, 2, 3, 4})
        for (const cv::Size size : {cv::Size(64, 48), cv::Size(160, 120)}) {
          CAPTURE(static_cast<int>(codec));
          CAPTURE(static_cast<int>(container));
          CAPTURE(frames);
          CAPTURE(size.width);
          const TemporaryFolder folder;
          write_clip(folder / "a", tagged_format(codec, container, PixelLayout::yuv420, size), frames);
          const FrameSource source = opened(folder / "a");
          REQUIRE(source.info().frame_count() == frames);
          for (int n = 0; n < frames; ++n)
            CHECK(source.info().times_s[static_cast<size_t>(n)] ==
                  doctest::Approx(n * source.info().times_s.back() / std::max(1, frames - 1)).epsilon(0.05));
        }
}

TEST_CASE("a frame whose time is not later than that of the one before is refused") {
  const TemporaryFolder folder;
  const VideoFormat format = tagged_format(VideoCodec::ffv1, Container::mkv, PixelLayout::gray, {16, 16});
  for (const double second_s : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    Result<VideoWriter> writer = VideoWriter::open(folder / "a.mkv", format);
    REQUIRE(writer.has_value());
    Frame frame = test_frame(format.layout, format.size_px, 0);
    CHECK(writer->write(frame, 0).has_value());
    frame.time_s = second_s;
    CHECK(!writer->write(frame, 1).has_value());
  }
}

TEST_CASE("a PNG sequence names the images by their numbers") {
  const TemporaryFolder folder;
  VideoFormat format = tagged_format(VideoCodec::png, Container::mkv, PixelLayout::rgb, {33, 21});
  Result<VideoWriter> writer = VideoWriter::open(folder.path(), format);
  REQUIRE(writer.has_value());
  const Frame frame = test_frame(PixelLayout::rgb, {33, 21}, 4);
  REQUIRE(writer->write(frame, 123).has_value());
  REQUIRE(writer->finish().has_value());
  const cv::Mat read = cv::imread((folder / "frame_000123.png").string(), cv::IMREAD_UNCHANGED);
  CHECK(cv::norm(read, bgr_of(frame), cv::NORM_INF) == 0);
}

TEST_CASE("gray images become gray PNG files") {
  const TemporaryFolder folder;
  VideoFormat format = tagged_format(VideoCodec::png, Container::mkv, PixelLayout::gray, {33, 21});
  format.color.range = ColorRange::full;
  Result<VideoWriter> writer = VideoWriter::open(folder.path(), format);
  REQUIRE(writer.has_value());
  const Frame frame = test_frame(PixelLayout::gray, {33, 21}, 4, format.color);
  REQUIRE(writer->write(frame, 0).has_value());
  const cv::Mat read = cv::imread((folder / "frame_000000.png").string(), cv::IMREAD_UNCHANGED);
  REQUIRE(read.type() == CV_8UC1);
  CHECK(cv::norm(read, frame.planes[0], cv::NORM_INF) == 0);
}

TEST_CASE("containers have their usual extensions") {
  CHECK(std::string(extension_of(Container::mkv)) == "mkv");
  CHECK(std::string(extension_of(Container::mp4)) == "mp4");
  CHECK(std::string(extension_of(Container::avi)) == "avi");
}
