// SPDX-License-Identifier: MIT
#include "render/gl_objects.h"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "render/scenes.h"

namespace sigs {

using test::same_bytes;

TEST_CASE("images that live at the same time do not share memory") {
  BufferPool pool;
  std::array<cv::Mat, 4> images;
  for (int i = 0; i < 4; ++i) {
    images[static_cast<std::size_t>(i)] = pool.image({40 + i, 30}, i % 2 == 0 ? CV_32FC4 : CV_32FC1);
    images[static_cast<std::size_t>(i)].setTo(i);
  }
  for (int i = 0; i < 4; ++i) {
    const cv::Mat& image = images[static_cast<std::size_t>(i)];
    CHECK(image.size() == cv::Size(40 + i, 30));
    CHECK(image.type() == (i % 2 == 0 ? CV_32FC4 : CV_32FC1));
    CHECK(image.isContinuous());
    CHECK(cv::countNonZero(image.reshape(1) != i) == 0);
  }
}

TEST_CASE("the memory of an image is given out again when nothing shares it, not before") {
  BufferPool pool;
  cv::Mat first = pool.image({100, 80}, CV_32FC4);
  const uchar* const memory = first.data;
  cv::Mat part = first(cv::Rect(10, 10, 5, 5));
  first.release();
  CHECK(pool.image({100, 80}, CV_32FC4).data != memory);  // a part still shares it
  part.release();
  CHECK(pool.image({90, 80}, CV_32FC4).data == memory);
}

TEST_CASE("to OpenCV an image is whole, not a part of what its memory held before") {
  BufferPool pool;
  pool.image({40, 30}, CV_32FC4).setTo(7);
  cv::Mat image = pool.image({31, 21}, CV_32FC4);
  image.setTo(1);
  const cv::Mat copy = image.clone();
  const auto with_border = [](const cv::Mat& of) {
    cv::Mat bordered;
    cv::copyMakeBorder(of, bordered, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(0));
    return bordered;
  };
  CHECK(same_bytes(with_border(image), with_border(copy)));
  const auto blurred = [](const cv::Mat& of) {
    cv::Mat out;
    cv::blur(of, out, {5, 5}, {-1, -1}, cv::BORDER_CONSTANT);
    return out;
  };
  CHECK(same_bytes(blurred(image), blurred(copy)));
}

TEST_CASE("small images do not keep the memory of large ones") {
  BufferPool pool;
  for (const int side : {1000, 300, 90}) {
    const cv::Mat image = pool.image({side, side}, CV_32FC1);
    CHECK(image.u->size <= 4 * image.total() * image.elemSize());
  }
}

}  // namespace sigs
