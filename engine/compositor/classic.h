// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/layer.h"
#include "camera/camera.h"

namespace sigs {

// The paper's own compositing (section 3.2), kept as printed: whole pictures, 8 bits, a green screen for a key.
// All pictures are CV_8UC3, BGR, of the footage's size.

// The chroma key: pure green, BGR.
inline const cv::Vec3b kKeyGreen{0, 255, 0};

// Paper figure 2: the intruder before pure green. A pixel is the intruder's where its coverage is at least one half; it
// then has the intruder's own colour, so that no green mixes into the edge.
[[nodiscard]] cv::Mat on_green_screen(const Layer& layer, cv::Size picture_size_px);

// The stages of the paper's figure 4.
struct ClassicStages {
  cv::Mat input1;   // the footage
  cv::Mat input2;   // the intruder before green, as a pinhole camera with the same matrix sees it
  cv::Mat a;        // input 1, undistorted
  cv::Mat b;        // the intruder keyed into it
  cv::Mat c;        // distorted again
  cv::Mat d;        // blurred
  cv::Mat f;        // input 2, distorted and blurred the same way
  cv::Mat output;   // D where F is not pure green, else input 1
  cv::Mat changed;  // CV_8UC1, 255 where F is not pure green
};

// For every pixel of the distorted picture, where it comes from in the undistorted one (CV_32FC1 each; -1 where the
// lens has no ray). Depends on the camera alone.
struct DistortMaps {
  cv::Mat x;
  cv::Mat y;
};
[[nodiscard]] DistortMaps distort_maps(const Camera& camera);

// A picture bent by the lens as stage C is: bilinear, border where the lens has no ray. For masks as well (CV_8UC1).
[[nodiscard]] cv::Mat distorted(const cv::Mat& picture, const DistortMaps& maps, const cv::Scalar& border);

// Gaussian blur of a whole picture (8 bits) as stages D and F have it; sigma_px == 0 returns the picture itself. Above
// sigma 16 it is computed on a coarser grid and is within one code value of the kernel in full. Beyond the border the
// picture is mirrored; a sigma of more than twice its size along an axis leaves the mean along that axis.
[[nodiscard]] cv::Mat softened(const cv::Mat& picture, double sigma_px);

[[nodiscard]] ClassicStages classic_stages(const cv::Mat& input1, const cv::Mat& input2, const Camera& camera,
                                           const DistortMaps& maps, double sigma_px);

// The former method of the paper's figure 5: input 2 pasted where it is not green, no lens, no blur.
// Only input1, input2, output and changed are filled.
[[nodiscard]] ClassicStages plain_stages(const cv::Mat& input1, const cv::Mat& input2);

}  // namespace sigs
