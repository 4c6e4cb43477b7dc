// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "editor/preview/preview_state.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr std::size_t kLimit = 1 << 20;
const cv::Size kFrame(64, 64);
constexpr std::size_t kImage_bytes = 64 * 64 * 4;        // colour and mask
constexpr std::size_t kDecoded_bytes = 64 * 64 * 3 / 2;  // 4:2:0
constexpr int kStages = 12;

std::shared_ptr<const PreviewImage> image(bool staged) {
  PreviewImage made{.bgr = cv::Mat(kFrame, CV_8UC3, cv::Scalar::all(1)),
                    .mask = cv::Mat(kFrame, CV_8UC1, cv::Scalar(1))};
  for (int i = 0; staged && i < kStages; ++i)
    made.stages.push_back({"a", cv::Mat(kFrame, CV_8UC4, cv::Scalar::all(1))});
  return std::make_shared<const PreviewImage>(std::move(made));
}

// What is alive of all that was put into a preview state, weighed by the test itself.
struct PreviewStateFixture {
  PreviewState preview_state{PreviewLimits{.cache_bytes = kLimit}, [] {}};
  std::vector<std::pair<std::weak_ptr<const void>, std::size_t>> put_down;

  template <class T>
  std::shared_ptr<const T> noted(std::shared_ptr<const T> value, std::size_t bytes) {
    put_down.emplace_back(value, bytes);
    return value;
  }

  void put_decoded(FrameKey key) {
    auto decoded =
        std::make_shared<const DecodedFrame>(DecodedFrame{.frame = grey_frame({.size_px = kFrame, .times_s = {0}}, 0)});
    preview_state.put_decoded(key, noted(std::move(decoded), kDecoded_bytes));
  }
  void put_image(FrameKey key, bool was_wanted) {
    preview_state.put_image(key, noted(image(false), kImage_bytes), 1, was_wanted);
  }
  void put_staged(FrameKey key) {
    preview_state.put_staged(key, noted(image(true), kImage_bytes + kStages * kImage_bytes));
  }

  [[nodiscard]] std::size_t alive() const {
    std::size_t sum = 0;
    for (const auto& [value, bytes] : put_down) sum += value.expired() ? 0 : bytes;
    return sum;
  }
};

Revision revision(std::uint64_t number) {
  return {number, std::make_shared<const Project>()};
}

}  // namespace

TEST_CASE("images, decoded frames and stages stay within one limit whatever comes") {
  PreviewStateFixture fixture;
  std::size_t maximum = 0;
  for (std::uint64_t state = 1; state <= 3; ++state)
    for (int frame = 0; frame < 200; ++frame) {
      fixture.preview_state.want({.revision = revision(state), .frame = frame, .stages = frame % 50 > 25});
      fixture.preview_state.identify_revision(state, state, {.id = 1});
      fixture.put_decoded({1, frame});
      fixture.put_image({state, frame}, true);
      if (frame % 50 > 25) fixture.put_staged({state, frame});
      maximum = std::max(maximum, fixture.alive());
      const PreviewOutput shown = fixture.preview_state.shown();
      CHECK(shown.image_is_current);
    }
  CHECK(maximum > kLimit / 2);  // it is used
  CHECK(maximum <= kLimit);
}

TEST_CASE("stages that the view no longer asks for are let go") {
  PreviewStateFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .stages = true});
  fixture.preview_state.identify_revision(1, 1, {.id = 1});
  fixture.put_image({1, 0}, true);
  fixture.put_staged({1, 0});
  CHECK(fixture.preview_state.shown().staged != nullptr);
  fixture.preview_state.want({.revision = revision(1)});
  CHECK(fixture.alive() == kImage_bytes);
  fixture.put_staged({1, 0});  // that was still being made
  CHECK(fixture.alive() == kImage_bytes);
}

TEST_CASE("what is told of the memory is what is alive, with the window's textures") {
  PreviewStateFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .frame = 3});
  fixture.preview_state.identify_revision(1, 1, {.id = 1});
  for (int frame = 0; frame < 300; ++frame) {
    fixture.put_decoded({1, frame});
    fixture.put_image({1, frame}, frame == 3);
    const std::size_t textures = static_cast<std::size_t>(frame) * 1000;
    fixture.preview_state.set_texture_bytes(textures);
    const MemoryUse memory = fixture.preview_state.shown().memory;
    CHECK(memory.sum() == fixture.alive() + textures);
    CHECK(memory.sum() <= kLimit);
    CHECK(memory.limit == kLimit);
    CHECK(memory.textures == textures);
  }
  CHECK(fixture.preview_state.shown().image_is_current == true);
}

TEST_CASE("what is shown stays though it is larger than the limit, and nothing else does") {
  PreviewStateFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .frame = 3});
  fixture.preview_state.identify_revision(1, 1, {.id = 1});
  fixture.preview_state.set_texture_bytes(2 * kLimit);
  for (int frame = 0; frame < 9; ++frame) {
    fixture.put_decoded({1, frame});
    fixture.put_image({1, frame}, frame == 3);
  }
  CHECK(fixture.preview_state.shown().image_is_current);
  CHECK(fixture.alive() == kImage_bytes + kDecoded_bytes);
  CHECK(fixture.preview_state.shown().memory.shown == kImage_bytes + kDecoded_bytes);
}
