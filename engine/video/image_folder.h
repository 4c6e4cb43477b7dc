// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"
#include "video/video_writer.h"

namespace sigs {

// Whether a codec writes a folder of numbered images instead of a video: png, tiff, jpeg.
[[nodiscard]] bool writes_images(VideoCodec codec);

// The extension of its images with the dot: ".png", ".tiff", ".jpg". Empty for the other codecs.
[[nodiscard]] const char* image_extension_of(VideoCodec codec);

// Writes one image as folder/frame_000123.png: gray for gray footage (as full range), else RGB; 16-bit
// for frames of more than 8 bits, but JPEG. PNG and TIFF (LZW) keep every sample of it; JPEG is 4:2:0 of
// VideoFormat::jpeg_quality. Error write_failed.
[[nodiscard]] Result<void> write_numbered_image(const std::filesystem::path& folder, const VideoFormat& format,
                                                const Frame& frame, int number);

}  // namespace sigs
