// SPDX-License-Identifier: MIT
#include "base/png.h"

#include <png.h>
#include <zlib.h>

#include <bit>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <exception>

namespace sigs::image_codecs {

namespace {

constexpr std::uint32_t kMaxSide_px = 1U << 14;  // larger ones are left to OpenCV, which knows limits of its own

// What libpng holds while it reads or writes, freed at the end.
struct PngState {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::FILE* file = nullptr;
  bool is_writing = false;

  PngState() = default;
  PngState(const PngState&) = delete;
  PngState& operator=(const PngState&) = delete;
  ~PngState() {
    if (is_writing)
      png_destroy_write_struct(&png, &info);
    else
      png_destroy_read_struct(&png, &info, nullptr);
    if (file != nullptr) std::fclose(file);
  }
};

void ignore(png_structp /*png*/, png_const_charp /*warning*/) {}

// In place of libpng's own, which also prints.
[[noreturn]] void end_step(png_structp png, png_const_charp /*error*/) {
  png_longjmp(png, 1);
}

// libpng ends a failed step by longjmp. So each step is a function of its own, without objects that have to be
// destroyed, which returns whether it has succeeded.

bool read_header(PngState& state) {
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  png_init_io(state.png, state.file);
  png_read_info(state.png, state.info);
  return true;
}

bool read_rows(PngState& state, uchar* first, std::size_t step_bytes, int rows) {
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  png_set_bgr(state.png);
  png_read_update_info(state.png, state.info);
  for (int y = 0; y < rows; ++y) png_read_row(state.png, first + static_cast<std::size_t>(y) * step_bytes, nullptr);
  png_read_end(state.png, nullptr);
  return true;
}

int channels_of(png_byte color_type) {
  return color_type == PNG_COLOR_TYPE_GRAY        ? 1
         : color_type == PNG_COLOR_TYPE_RGB       ? 3
         : color_type == PNG_COLOR_TYPE_RGB_ALPHA ? 4
                                                  : 0;
}

bool is_plain(const PngState& state) {
  return png_get_bit_depth(state.png, state.info) == 8 && channels_of(png_get_color_type(state.png, state.info)) > 0 &&
         png_get_interlace_type(state.png, state.info) == PNG_INTERLACE_NONE &&
         png_get_valid(state.png, state.info, PNG_INFO_tRNS) == 0 &&
         png_get_image_width(state.png, state.info) <= kMaxSide_px &&
         png_get_image_height(state.png, state.info) <= kMaxSide_px;
}

void append_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto& all = *static_cast<std::vector<uchar>*>(png_get_io_ptr(png));
  bool has_memory = true;
  try {
    all.insert(all.end(), bytes, bytes + count);
  } catch (const std::exception&) {
    has_memory = false;
  }
  if (!has_memory) png_error(png, "no memory");
}

// The settings of OpenCV's encoder: fast, each row as differences from sample to sample.
bool write_image(PngState& state, const cv::Mat& image) {
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  const int channels = image.channels();
  png_set_filter(state.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(state.png, Z_BEST_SPEED);
  png_set_compression_strategy(state.png, Z_RLE);
  png_set_IHDR(state.png, state.info, static_cast<png_uint_32>(image.cols), static_cast<png_uint_32>(image.rows),
               image.depth() == CV_8U ? 8 : 16,
               channels == 1   ? PNG_COLOR_TYPE_GRAY
               : channels == 3 ? PNG_COLOR_TYPE_RGB
                               : PNG_COLOR_TYPE_RGB_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(state.png, state.info);
  png_set_bgr(state.png);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(state.png);  // PNG's words: high byte first
  for (int y = 0; y < image.rows; ++y) png_write_row(state.png, image.ptr(y));
  png_write_end(state.png, state.info);
  return true;
}

}  // namespace

cv::Mat plain_png(const std::string& file) {
  PngState state;
  state.file = std::fopen(file.c_str(), "rb");
  if (state.file == nullptr) return {};
  state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, end_step, ignore);
  if (state.png != nullptr) state.info = png_create_info_struct(state.png);
  if (state.info == nullptr || !read_header(state) || !is_plain(state)) return {};
  cv::Mat image(static_cast<int>(png_get_image_height(state.png, state.info)),
                static_cast<int>(png_get_image_width(state.png, state.info)),
                CV_8UC(channels_of(png_get_color_type(state.png, state.info))));
  return read_rows(state, image.data, image.step, image.rows) ? image : cv::Mat();
}

std::vector<uchar> plain_png_bytes(const cv::Mat& image) {
  const int channels = image.channels();
  const bool is_plain = !image.empty() && image.dims == 2 && (image.depth() == CV_8U || image.depth() == CV_16U) &&
                        (channels == 1 || channels == 3 || channels == 4);
  if (!is_plain) return {};
  PngState state;
  state.is_writing = true;
  state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, end_step, ignore);
  if (state.png != nullptr) state.info = png_create_info_struct(state.png);
  if (state.info == nullptr) return {};
  std::vector<uchar> bytes;
  png_set_write_fn(state.png, &bytes, append_bytes, nullptr);
  return write_image(state, image) ? bytes : std::vector<uchar>();
}

}  // namespace sigs::image_codecs
