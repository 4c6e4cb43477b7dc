// SPDX-License-Identifier: MIT
#include "video/patch_recompression.h"

#include <algorithm>

#include "base/ensure.h"
#include "video/dct_blocks.h"
#include "video/h264_residual.h"

namespace sigs {
namespace {

constexpr int kBlock_px = FrameQuantisers::kBlock_px;

cv::Mat clamped(const cv::Mat& quantisers, int low, int high) {
  cv::Mat within;
  cv::max(quantisers, low, within);
  cv::min(within, high, within);
  return within;
}

cv::Mat chroma_qps(const cv::Mat& luma_qp, int offset) {
  cv::Mat qp = luma_qp.clone();
  for (int row = 0; row < qp.rows; ++row)
    for (int column = 0; column < qp.cols; ++column)
      qp.at<short>(row, column) = static_cast<short>(chroma_qp(qp.at<short>(row, column), offset));
  return qp;
}

// Planes of colour that are as large as luma's are coded as luma is. Which of their blocks are filtered is luma's
// choice.
void code_full_plane(cv::Mat& plane, const cv::Mat& before, const cv::Mat& qp, const cv::Mat& coded_luma) {
  code_luma(plane, before, qp);
  deblock_luma(plane, {coded_luma, qp});
}

void code_h264(Frame& patch, const Frame& before, const PatchCoding& coding) {
  const cv::Size step = chroma_step(patch.layout);
  const CodedBlocks luma = code_luma(patch.planes[0], before.planes[0], clamped(coding.quantisers, 0, 51));
  deblock_luma(patch.planes[0], luma);
  for (int i = 1; i < patch.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const int offset = i == 1 ? coding.cb_offset : coding.cr_offset;
    if (patch.layout == PixelLayout::rgb) {
      code_full_plane(patch.planes[which], before.planes[which], luma.qp, luma.coded);
    } else if (step == cv::Size(1, 1)) {
      code_full_plane(patch.planes[which], before.planes[which], chroma_qps(luma.qp, offset), luma.coded);
    } else {
      code_chroma(patch.planes[which], before.planes[which], luma.qp, step, offset);
      deblock_chroma(patch.planes[which], luma, step, offset);
    }
  }
}

void code_plane(Frame& patch, const Frame& before, const PatchCoding& coding, std::size_t which) {
  const bool is_chroma = which > 0 && patch.layout != PixelLayout::rgb;
  const cv::Size step = is_chroma ? chroma_step(patch.layout) : cv::Size(1, 1);
  if (coding.kind == QuantiserKind::jpeg)
    code_jpeg(patch.planes[which], before.planes[which], is_chroma ? coding.tables.chroma : coding.tables.luma);
  else
    code_mpeg(patch.planes[which], before.planes[which], clamped(coding.quantisers, 1, 255),
              {kBlock_px / step.width, kBlock_px / step.height});
}

}  // namespace

Frame recompressed(const Frame& patch, const Frame& before, const PatchCoding& coding) {
  const cv::Size size = patch.size_px();
  ENSURE(patch.layout == before.layout && size == before.size_px());
  ENSURE(size.width % kBlock_px == 0 && size.height % kBlock_px == 0);
  Frame coded = cloned(patch);
  if (coding.kind == QuantiserKind::none) return coded;
  ENSURE(coding.kind == QuantiserKind::jpeg || coding.quantisers.size() == size / kBlock_px);
  if (coding.kind == QuantiserKind::h264)
    code_h264(coded, before, coding);
  else
    for (int i = 0; i < coded.plane_count(); ++i) code_plane(coded, before, coding, static_cast<std::size_t>(i));
  return coded;
}

}  // namespace sigs
