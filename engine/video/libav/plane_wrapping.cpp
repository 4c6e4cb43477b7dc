// SPDX-License-Identifier: MIT
#include "video/libav/plane_wrapping.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <memory>
#include <new>

#include "base/ensure.h"

namespace sigs::libav {
namespace {

void give_back(void* plane, uint8_t* /*samples*/) {
  delete static_cast<cv::Mat*>(plane);
}

// Holds a share in the plane until FFmpeg drops the last reference.
AVBufferRef* share_in(const cv::Mat& plane) {
  auto held = std::make_unique<cv::Mat>(plane);
  const size_t bytes = static_cast<size_t>(plane.rows - 1) * plane.step + static_cast<size_t>(plane.cols);
  AVBufferRef* share = av_buffer_create(plane.data, bytes, give_back, held.get(), AV_BUFFER_FLAG_READONLY);
  if (share == nullptr) throw std::bad_alloc();
  static_cast<void>(held.release());
  return share;
}

}  // namespace

bool can_wrap_planes(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  ENSURE(description != nullptr);
  for (int i = 0; i < description->nb_components; ++i) {
    const AVComponentDescriptor& component = description->comp[i];
    if (component.plane != i || component.step != 1 || component.offset != 0 || component.depth != 8) return false;
  }
  return true;
}

void wrap_planes(AVFrame& image, const Frame& frame) {
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Mat& plane = frame.planes[static_cast<size_t>(i)];
    image.buf[i] = share_in(plane);
    image.data[i] = plane.data;
    image.linesize[i] = static_cast<int>(plane.step);
  }
}

}  // namespace sigs::libav
