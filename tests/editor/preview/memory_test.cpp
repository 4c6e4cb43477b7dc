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
const cv::Size kFrameSize(64, 64);
constexpr std::size_t kImage_bytes = 64 * 64 * 4;        // colour and mask
constexpr std::size_t kDecoded_bytes = 64 * 64 * 3 / 2;  // 4:2:0
constexpr int kStages = 12;

std::shared_ptr<const PreviewImage> image(bool staged) {
  PreviewImage made{.bgr = {.ground = cv::Mat(kFrameSize, CV_8UC3, cv::Scalar::all(1)), .patch = {}, .patch_at = {}},
                    .mask = cv::Mat(kFrameSize, CV_8UC1, cv::Scalar(1))};
  for (int i = 0; staged && i < kStages; ++i)
    made.stages.push_back({"a", cv::Mat(kFrameSize, CV_8UC4, cv::Scalar::all(1))});
  return std::make_shared<const PreviewImage>(std::move(made));
}

// The memory of all images put into a preview state that still exist, summed by the test itself.
struct MemoryFixture {
  PreviewState preview_state{PreviewLimits{.cache_bytes = kLimit}, [] {}};
  std::vector<std::pair<std::weak_ptr<const void>, std::size_t>> put_down;

  template <class T>
  std::shared_ptr<const T> noted(std::shared_ptr<const T> value, std::size_t bytes) {
    put_down.emplace_back(value, bytes);
    return value;
  }

  void put_decoded(FrameKey key) {
    auto decoded = std::make_shared<const DecodedFrame>(
        DecodedFrame{.frame = grey_frame({.size_px = kFrameSize, .times_s = {0}}, 0)});
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

// Each number has other images.
Revision revision(std::uint64_t number) {
  Project project;
  project.camera.speed_mps = static_cast<double>(number);
  return {number, std::make_shared<const Project>(std::move(project))};
}

constexpr ContentId kFiles{.low = 5};
constexpr ContentId kFootage{.low = 6};

FrameKey image_key(std::uint64_t revision_number, int frame) {
  return {combined_id(revision(revision_number).content, kFiles), frame};
}

}  // namespace

TEST_CASE("images, decoded frames and stages stay within one limit after any requests") {
  MemoryFixture fixture;
  std::size_t maximum = 0;
  for (std::uint64_t number = 1; number <= 3; ++number)
    for (int frame = 0; frame < 200; ++frame) {
      fixture.preview_state.want({.revision = revision(number), .frame = frame, .stages = frame % 50 > 25});
      fixture.preview_state.set_input_files(kFiles, {.id = kFootage});
      fixture.put_decoded({kFootage, frame});
      fixture.put_image(image_key(number, frame), true);
      if (frame % 50 > 25) fixture.put_staged(image_key(number, frame));
      maximum = std::max(maximum, fixture.alive());
      const PreviewOutput shown = fixture.preview_state.shown();
      CHECK(shown.image_is_current);
    }
  CHECK(maximum > kLimit / 2);  // it is used
  CHECK(maximum <= kLimit);
}

TEST_CASE("stages that the view no longer asks for are released") {
  MemoryFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .stages = true});
  fixture.preview_state.set_input_files(kFiles, {.id = kFootage});
  fixture.put_image(image_key(1, 0), true);
  fixture.put_staged(image_key(1, 0));
  CHECK(fixture.preview_state.shown().staged != nullptr);
  fixture.preview_state.want({.revision = revision(1)});
  CHECK(fixture.alive() == kImage_bytes);
  fixture.put_staged(image_key(1, 0));  // that was still being made
  CHECK(fixture.alive() == kImage_bytes);
}

TEST_CASE("the reported memory is the memory in use, with the window's textures") {
  MemoryFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .frame = 3});
  fixture.preview_state.set_input_files(kFiles, {.id = kFootage});
  for (int frame = 0; frame < 300; ++frame) {
    fixture.put_decoded({kFootage, frame});
    fixture.put_image(image_key(1, frame), frame == 3);
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

TEST_CASE("the shown image is kept though it is larger than the limit, and nothing else is") {
  MemoryFixture fixture;
  fixture.preview_state.want({.revision = revision(1), .frame = 3});
  fixture.preview_state.set_input_files(kFiles, {.id = kFootage});
  fixture.preview_state.set_texture_bytes(2 * kLimit);
  for (int frame = 0; frame < 9; ++frame) {
    fixture.put_decoded({kFootage, frame});
    fixture.put_image(image_key(1, frame), frame == 3);
  }
  CHECK(fixture.preview_state.shown().image_is_current);
  CHECK(fixture.alive() == kImage_bytes + kDecoded_bytes);
  CHECK(fixture.preview_state.shown().memory.shown == kImage_bytes + kDecoded_bytes);
}
