// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/image.h"
#include "camera/camera.h"
#include "video/frame.h"

namespace sigs {

// The paper's own compositing (section 3.2), kept as printed: whole images, 8 bits, a green screen for a key.
// All images are CV_8UC3, BGR, of the footage's size, whatever its depth.

// The chroma key: pure green, BGR.
inline const cv::Vec3b kKeyGreen{0, 255, 0};

// Paper figure 2: the intruder before pure green. A pixel is the intruder's where its coverage is at least one half; it
// then has the intruder's own colour, so that no green mixes into the edge. Written over buffer, where one is given.
// color: the footage's, whose transfer function and primaries apply to the image as well
[[nodiscard]] cv::Mat on_green_screen(const Layer& layer, const ColorInfo& color, cv::Size image_size_px,
                                      cv::Mat buffer = {});

// The stages of the paper's figure 4.
struct ClassicStages {
  cv::Mat input1;   // the footage
  cv::Mat input2;   // the intruder before green, as a pinhole camera with the same matrix sees it
  cv::Mat a;        // input 1, undistorted
  cv::Mat b;        // the intruder keyed into it
  cv::Mat c;        // distorted again
  cv::Mat d;        // blurred
  cv::Mat e;        // input 2, distorted the same way
  cv::Mat f;        // blurred the same way
  cv::Mat output;   // D where F is not pure green, else input 1
  cv::Mat changed;  // CV_8UC1, 255 where F is not pure green
  cv::Mat key;      // CV_8UC1, 255 where input 2 is not pure green
};

// Where every pixel of an image comes from in another one, in the 32nds of a pixel that cv::remap reads by
// (cv::convertMaps: CV_16SC2 and CV_16UC1).
struct FixedMap {
  cv::Mat pixels;
  cv::Mat shares;
};

// Both ways between the footage and the undistorted image; depends on the camera alone.
struct DistortMaps {
  cv::Mat x;            // for every pixel of the distorted image, where it comes from in the undistorted one (CV_32FC1)
  cv::Mat y;            // -1 where the lens has no ray
  FixedMap distorting;  // x and y
  FixedMap undistorting;  // cv::undistort's or cv::fisheye::undistortImage's
};
[[nodiscard]] DistortMaps distort_maps(const Camera& camera);

// An image warped by the lens as stage C is: bilinear, border where the lens has no ray. For masks as well (CV_8UC1).
// Only the pixels of part are made, where it is given.
[[nodiscard]] cv::Mat distorted(const cv::Mat& image, const DistortMaps& maps, const cv::Scalar& border);
[[nodiscard]] cv::Mat distorted(const cv::Mat& image, const DistortMaps& maps, const cv::Scalar& border,
                                const cv::Rect& part);

// Gaussian blur of a whole image (8 bits) as stages D and F have it; sigma_px == 0 returns the image itself. Above
// sigma 16 it is computed on a coarser grid and is within one code value of the kernel in full. Beyond the border the
// image is mirrored; a sigma of more than twice its size along an axis leaves the mean along that axis.
[[nodiscard]] cv::Mat gaussian_blurred(const cv::Mat& image, double sigma_px, cv::Mat buffer = {});

// The part of an image that a part of the blurred image depends on.
[[nodiscard]] cv::Rect gaussian_blur_source(const cv::Rect& part, double sigma_px, cv::Size image_size_px);

//   buffers  of another frame, to be written over: filling fresh memory takes longer than some of the stages
[[nodiscard]] ClassicStages classic_stages(const cv::Mat& input1, const cv::Mat& input2, const DistortMaps& maps,
                                           double sigma_px, ClassicStages buffers = {});

// The earlier method of the paper's figure 5: input 2 pasted where it is not green, no lens, no blur.
// Only input1, input2, output, changed and key are filled.
[[nodiscard]] ClassicStages plain_stages(const cv::Mat& input1, const cv::Mat& input2, ClassicStages buffers = {});

}  // namespace sigs
