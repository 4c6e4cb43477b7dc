// SPDX-License-Identifier: MIT
#include "editor/preview/opened_footage.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "preview_client.h"
#include "video/chroma.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

Frame random_frame(PixelLayout layout, ChromaSite site, cv::Size size_px, int bit_depth, cv::RNG& random) {
  Frame frame = blank_frame(layout, size_px, {.chroma_site = site}, bit_depth);
  for (int i = 0; i < frame.plane_count(); ++i)
    random.fill(frame.planes[static_cast<std::size_t>(i)], cv::RNG::UNIFORM, 0, 1 << bit_depth);
  return frame;
}

cv::Rect random_rect(const cv::Size& within, cv::RNG& random) {
  const cv::Point a(random.uniform(0, within.width), random.uniform(0, within.height));
  const cv::Point b(random.uniform(0, within.width), random.uniform(0, within.height));
  return cv::Rect(a, b) | cv::Rect(a, cv::Size(1, 1));
}

}  // namespace

TEST_CASE("a part of a frame is converted to the pixels that the whole is converted to") {
  cv::RNG random(11);
  for (const PixelLayout layout :
       {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const ChromaSite site : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left})
      for (const int bit_depth : {8, 10})
        for (const cv::Size size_px : {cv::Size(64, 48), cv::Size(33, 21)}) {
          const Frame frame = random_frame(layout, site, size_px, bit_depth, random);
          const cv::Mat whole = bgr_of(frame);
          for (int i = 0; i < 20; ++i) {
            const cv::Rect part = random_rect(size_px, random);
            CHECK(is_same_image(bgr_of_part(frame, part), whole(part)));
          }
        }
}

namespace {

std::shared_ptr<const DecodedFrame> decoded(PixelLayout layout, cv::Size size_px, cv::RNG& random) {
  return std::make_shared<const DecodedFrame>(
      DecodedFrame{random_frame(layout, ChromaSite::left, size_px, 8, random), ""});
}

// As compositing does it: pixels change with the chroma samples that they share with others, and the mask says so.
ComposedFrame changed(Frame frame, const cv::Rect& part, cv::RNG& random) {
  const cv::Size step = chroma_step(frame.layout);
  const cv::Rect chroma(cv::Point(part.x / step.width, part.y / step.height),
                        cv::Point((part.br().x + 1) / step.width, (part.br().y + 1) / step.height));
  ComposedFrame composed{
      .image = std::move(frame), .mask = {}, .truth = {}, .stages = {}, .times = {}, .op_counts = {}};
  composed.mask = cv::Mat::zeros(composed.image.size_px(), CV_8UC1);
  composed.mask(part).setTo(1);
  for (int i = 0; i < composed.image.plane_count(); ++i) {
    cv::Mat& plane = composed.image.planes[static_cast<std::size_t>(i)];
    cv::Mat samples = plane((i == 0 ? part : chroma) & cv::Rect({0, 0}, plane.size()));
    random.fill(samples, cv::RNG::UNIFORM, 0, 256);
  }
  return composed;
}

}  // namespace

TEST_CASE("a patched image is every pixel of what was composited, one after the other on the same copy") {
  cv::RNG random(13);
  const cv::Size size_px(301, 201);
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv444, PixelLayout::gray}) {
    const auto footage = decoded(layout, size_px, random);
    FootageCopies copies;
    for (const cv::Rect& part : {cv::Rect(120, 80, 31, 17), cv::Rect(0, 0, 3, 3), cv::Rect(298, 190, 3, 11)}) {
      Frame copy = copies.to_composite(footage);
      for (int i = 0; i < copy.plane_count(); ++i) {
        const auto plane = static_cast<std::size_t>(i);
        CHECK(is_same_image(copy.planes[plane], footage->frame.planes[plane]));  // nothing is left of the one before
        CHECK(copy.planes[plane].data != footage->frame.planes[plane].data);
      }
      ComposedFrame composed = changed(std::move(copy), part, random);
      const cv::Mat whole = bgr_of(composed.image);
      const PatchedImage image = copies.patched(footage, composed);
      CHECK(is_same_image(image.whole(), whole));
      CHECK(image.ground.samples() == footage->frame.planes[0].data);  // not another copy
      CHECK(image.patch.bytes() < image.ground.bytes());
      // A pixel by itself, and at the patch's edges.
      for (const cv::Rect& seen : {cv::Rect(image.patch_at, cv::Size(1, 1)), image.patch_rect(), part})
        CHECK(is_same_image(image.part(seen), whole(seen)));
    }
  }
}

TEST_CASE("a frame without an intruder is its footage") {
  cv::RNG random(17);
  const auto footage = decoded(PixelLayout::yuv420, {64, 48}, random);
  FootageCopies copies;
  for (const cv::Mat& mask : {cv::Mat(), cv::Mat(cv::Mat::zeros(48, 64, CV_8UC1))}) {
    ComposedFrame composed{
        .image = copies.to_composite(footage), .mask = mask, .truth = {}, .stages = {}, .times = {}, .op_counts = {}};
    const PatchedImage image = copies.patched(footage, composed);
    CHECK(image.patch.empty());
    CHECK(is_same_image(image.whole(), bgr_of(footage->frame)));
  }
}

TEST_CASE("another frame is another image, and the copy of the one before is not taken for it") {
  cv::RNG random(19);
  const auto one = decoded(PixelLayout::yuv420, {32, 32}, random);
  const auto other = decoded(PixelLayout::yuv420, {32, 32}, random);
  FootageCopies copies;
  ComposedFrame composed = changed(copies.to_composite(one), {4, 4, 8, 8}, random);
  CHECK(is_same_image(copies.patched(one, composed).ground.whole(), bgr_of(one->frame)));
  CHECK(is_same_image(shown(other).whole(), bgr_of(other->frame)));
  CHECK(is_same_image(copies.to_composite(other).planes[0], other->frame.planes[0]));
}

TEST_CASE("made smaller, a patched image is one image: its blocks are those of the whole, and of the footage outside") {
  cv::RNG random(23);
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::gray})
    for (const cv::Rect& part : {cv::Rect(140, 90, 31, 17), cv::Rect(0, 0, 3, 3), cv::Rect(298, 190, 3, 11)}) {
      const auto footage = decoded(layout, {301, 201}, random);
      FootageCopies copies;
      ComposedFrame composed = changed(copies.to_composite(footage), part, random);
      const auto frame = std::make_shared<const Frame>(cloned(composed.image));
      const PatchedImage image = copies.patched(footage, composed);
      for (int divisor = 2; divisor <= 9; ++divisor) {
        const cv::Rect all({0, 0}, image.size());
        const cv::Mat expected = ShownImage(frame).reduced(all, divisor);
        cv::Mat drawn = image.ground.reduced(all, divisor).clone();
        const DrawnPatch patch = drawn_patch(image, divisor);
        const cv::Mat reduced = image.patch.reduced(patch.reduced - image.patch_at, divisor);
        reduced.copyTo(drawn(cv::Rect(patch.reduced.tl() / divisor, reduced.size())));
        CHECK(is_same_image(drawn, expected));
      }
    }
}
