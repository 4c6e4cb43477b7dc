// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"
#include "video/libav/encoder.h"
#include "video/libav/lending.h"
#include "video/libav/sparse_ffv1.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// FFmpeg's own packets, on one thread.
class Reference {
 public:
  explicit Reference(cv::Size size_px) {
    const VideoFormat format{
        .codec = VideoCodec::ffv1, .container = Container::mkv, .size_px = size_px, .layout = PixelLayout::gray};
    Result<libav::CodecPtr> encoder = libav::open_encoder(format, *libav::encoding_for(format), {1, 1000}, true);
    REQUIRE(encoder.has_value());
    encoder_ = std::move(*encoder);
  }

  [[nodiscard]] std::vector<uint8_t> packet_of(const cv::Mat& picture) {
    const libav::FramePtr frame = libav::new_frame();
    frame->format = AV_PIX_FMT_GRAY8;
    frame->width = picture.cols;
    frame->height = picture.rows;
    libav::lend(*frame, Frame{.layout = PixelLayout::gray, .planes = {picture}});
    const libav::PacketPtr packet = libav::new_packet();
    REQUIRE(avcodec_send_frame(encoder_.get(), frame.get()) >= 0);
    REQUIRE(avcodec_receive_packet(encoder_.get(), packet.get()) >= 0);
    return {packet->data, packet->data + packet->size};
  }

 private:
  libav::CodecPtr encoder_;
};

libav::SparseFfv1 sparse_like(Reference& reference, cv::Size size_px) {
  const auto encode = [&](const cv::Mat& picture) { return reference.packet_of(picture); };
  std::optional<libav::SparseFfv1> sparse = libav::SparseFfv1::like(encode, size_px);
  REQUIRE(sparse.has_value());
  return *std::move(sparse);
}

cv::Mat noise(cv::Size size_px, int below, int share_of_8, unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat picture = cv::Mat::zeros(size_px, CV_8UC1);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (static_cast<int>(random() % 8) < share_of_8)
        picture.at<uint8_t>(y, x) = static_cast<uint8_t>(random() % static_cast<unsigned>(below));
  return picture;
}

// A mask's usual content: an opaque shape with soft edges.
cv::Mat blob(cv::Size size_px, cv::Point2d at, double radius_px) {
  cv::Mat picture = cv::Mat::zeros(size_px, CV_8UC1);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double inside = radius_px - std::hypot(x - at.x, (y - at.y) * 3) + 1;
      picture.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(127 * inside);
    }
  return picture;
}

}  // namespace

TEST_CASE("a mostly black picture makes the packet that the FFV1 encoder makes of it") {
  for (const cv::Size size : {cv::Size(4, 4), cv::Size(33, 21), cv::Size(160, 97), cv::Size(353, 40),
                              cv::Size(641, 482), cv::Size(1280, 960)}) {
    CAPTURE(size.width);
    CAPTURE(size.height);
    Reference reference(size);
    const libav::SparseFfv1 sparse = sparse_like(reference, size);
    const int high = size.height / 4;
    int made = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
      const int below = 2 << seed % 8;
      cv::Mat picture = cv::Mat::zeros(size, CV_8UC1);
      const int top = seed % 3 == 0 ? 0 : seed % 3 == 1 ? size.height - high : size.height / 2 - high / 2;
      noise({size.width, high}, below, 1 + static_cast<int>(seed) % 8, seed)
          .copyTo(picture(cv::Rect(0, top, size.width, high)));
      const auto packet = sparse.packet_of(picture);
      REQUIRE(packet.has_value());
      CHECK(*packet == reference.packet_of(picture));
      made += packet.has_value() ? 1 : 0;
    }
    for (const cv::Point2d at :
         {cv::Point2d(0.5, 0.5), cv::Point2d(0, 0.25), cv::Point2d(1, 1), cv::Point2d(0.7, 0.2)}) {
      const cv::Mat picture = blob(size, {at.x * size.width, at.y * size.height}, size.height / 4.0);
      if (const auto packet = sparse.packet_of(picture)) {
        CHECK(*packet == reference.packet_of(picture));
        ++made;
      }
    }
    CHECK(made >= 24);
  }
}

TEST_CASE("lone samples at the borders of slices make the encoder's packets") {
  const cv::Size size(66, 50);
  Reference reference(size);
  const libav::SparseFfv1 sparse = sparse_like(reference, size);
  for (const int y : {0, 1, 23, 24, 25, 26, 48, 49})
    for (const int x : {0, 1, 31, 32, 33, 34, 64, 65})
      for (const int value : {1, 127, 128, 255}) {
        cv::Mat picture = cv::Mat::zeros(size, CV_8UC1);
        picture.at<uint8_t>(y, x) = static_cast<uint8_t>(value);
        const auto packet = sparse.packet_of(picture);
        REQUIRE(packet.has_value());
        CHECK(*packet == reference.packet_of(picture));
      }
}

TEST_CASE("a picture with much in it is left to the encoder") {
  const cv::Size size(64, 48);
  Reference reference(size);
  const libav::SparseFfv1 sparse = sparse_like(reference, size);
  CHECK(!sparse.packet_of(noise(size, 256, 8, 1)).has_value());
}

TEST_CASE("an encoder whose packets are not those of FFmpeg's FFV1 is not imitated") {
  const cv::Size size(64, 48);
  Reference reference(size);
  const auto other = [&](const cv::Mat& picture) {
    std::vector<uint8_t> packet = reference.packet_of(picture);
    if (cv::countNonZero(picture) > 0) packet[packet.size() / 2] ^= 1;
    return packet;
  };
  CHECK(!libav::SparseFfv1::like(other, size).has_value());
  CHECK(!libav::SparseFfv1::like([](const cv::Mat&) { return std::vector<uint8_t>(); }, size).has_value());
  CHECK(!libav::SparseFfv1::like([](const cv::Mat&) { return std::vector<uint8_t>(100, 7); }, size).has_value());
}
