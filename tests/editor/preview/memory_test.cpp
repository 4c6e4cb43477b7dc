// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "editor/preview/board.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr std::size_t kLimit = 1 << 20;
const cv::Size kFrame(64, 64);
constexpr std::size_t kPicture_bytes = 64 * 64 * 4;      // colour and mask
constexpr std::size_t kDecoded_bytes = 64 * 64 * 3 / 2;  // 4:2:0
constexpr int kStages = 12;

std::shared_ptr<const Picture> picture(bool staged) {
  Picture made{.bgr = cv::Mat(kFrame, CV_8UC3, cv::Scalar::all(1)), .mask = cv::Mat(kFrame, CV_8UC1, cv::Scalar(1))};
  for (int i = 0; staged && i < kStages; ++i)
    made.stages.push_back({"a", cv::Mat(kFrame, CV_8UC4, cv::Scalar::all(1))});
  return std::make_shared<const Picture>(std::move(made));
}

// What is alive of all that was put down on a board, weighed by the test itself.
struct Table {
  Board board{PreviewLimits{.cache_bytes = kLimit}, [] {}};
  std::vector<std::pair<std::weak_ptr<const void>, std::size_t>> put_down;

  template <class T>
  std::shared_ptr<const T> noted(std::shared_ptr<const T> value, std::size_t bytes) {
    put_down.emplace_back(value, bytes);
    return value;
  }

  void put_decoded(FrameKey key) {
    auto decoded =
        std::make_shared<const Decoded>(Decoded{.frame = grey_frame({.size_px = kFrame, .times_s = {0}}, 0)});
    board.put_decoded(key, noted(std::move(decoded), kDecoded_bytes));
  }
  void put_picture(FrameKey key, bool was_wanted) {
    board.put_picture(key, noted(picture(false), kPicture_bytes), 1, was_wanted);
  }
  void put_staged(FrameKey key) {
    board.put_staged(key, noted(picture(true), kPicture_bytes + kStages * kPicture_bytes));
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

TEST_CASE("pictures, decoded frames and stages stay within one limit whatever comes") {
  Table table;
  std::size_t most = 0;
  for (std::uint64_t state = 1; state <= 3; ++state)
    for (int frame = 0; frame < 200; ++frame) {
      table.board.want({.revision = revision(state), .frame = frame, .stages = frame % 50 > 25});
      table.board.name_revision(state, state, {.id = 1});
      table.put_decoded({1, frame});
      table.put_picture({state, frame}, true);
      if (frame % 50 > 25) table.put_staged({state, frame});
      most = std::max(most, table.alive());
      const Shown shown = table.board.shown();
      CHECK(shown.picture_is_current);
    }
  CHECK(most > kLimit / 2);  // it is used
  CHECK(most <= kLimit);
}

TEST_CASE("stages that the view no longer asks for are let go") {
  Table table;
  table.board.want({.revision = revision(1), .stages = true});
  table.board.name_revision(1, 1, {.id = 1});
  table.put_picture({1, 0}, true);
  table.put_staged({1, 0});
  CHECK(table.board.shown().staged != nullptr);
  table.board.want({.revision = revision(1)});
  CHECK(table.alive() == kPicture_bytes);
  table.put_staged({1, 0});  // that was still being made
  CHECK(table.alive() == kPicture_bytes);
}

TEST_CASE("what is told of the memory is what is alive, with the window's textures") {
  Table table;
  table.board.want({.revision = revision(1), .frame = 3});
  table.board.name_revision(1, 1, {.id = 1});
  for (int frame = 0; frame < 300; ++frame) {
    table.put_decoded({1, frame});
    table.put_picture({1, frame}, frame == 3);
    const std::size_t textures = static_cast<std::size_t>(frame) * 1000;
    table.board.set_texture_bytes(textures);
    const MemoryUse memory = table.board.shown().memory;
    CHECK(memory.sum() == table.alive() + textures);
    CHECK(memory.sum() <= kLimit);
    CHECK(memory.limit == kLimit);
    CHECK(memory.textures == textures);
  }
  CHECK(table.board.shown().picture_is_current == true);
}

TEST_CASE("what is shown stays though it is larger than the limit, and nothing else does") {
  Table table;
  table.board.want({.revision = revision(1), .frame = 3});
  table.board.name_revision(1, 1, {.id = 1});
  table.board.set_texture_bytes(2 * kLimit);
  for (int frame = 0; frame < 9; ++frame) {
    table.put_decoded({1, frame});
    table.put_picture({1, frame}, frame == 3);
  }
  CHECK(table.board.shown().picture_is_current);
  CHECK(table.alive() == kPicture_bytes + kDecoded_bytes);
  CHECK(table.board.shown().memory.shown == kPicture_bytes + kDecoded_bytes);
}
