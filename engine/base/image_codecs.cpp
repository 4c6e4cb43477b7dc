// SPDX-License-Identifier: MIT
#include "base/image_codecs.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <system_error>

#include "base/image.h"
#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs::image_codecs {

// The PNG files that are read and written all the time, by libpng alone: OpenCV's library for image files takes longer
// to load than a frame takes to decode.

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

// A file of 8 bits as OpenCV's IMREAD_UNCHANGED gives it: CV_8UC1, CV_8UC3 (blue, green, red) or CV_8UC4. Empty for all
// that is to be left to OpenCV: other formats, palettes, other depths, interlaced and damaged files.
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

// The bytes of the PNG file that OpenCV writes of such an image without parameters. Empty where it is left to OpenCV:
// all types but CV_8U and CV_16U of 1, 3 or 4 channels.
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

}  // namespace

// SIGS_IMAGE_CODECS_FILES is set by CMakeLists.txt where the library can be loaded so: its file names, by which it is
// found among the system's libraries or where it was found when this was built. Else it is linked as any other.
#ifdef SIGS_IMAGE_CODECS_FILES

namespace {

[[noreturn]] void stop_for(const std::string& why) {
  throw std::system_error(ELIBACC, std::generic_category(),
                          "OpenCV's library for image files cannot be loaded: " + why);
}

// Stays loaded to the end.
void* library() {
  static void* const opened = [] {
    // The libraries below it, with the tables that some build while they are loaded, take 160 MiB; without memory for
    // its tables one of them ends the program.
    constexpr std::size_t kLibraries_bytes = std::size_t{176} << 20;
    if (!has_free_memory(kLibraries_bytes)) throw std::bad_alloc();
    void* found = nullptr;
    for (const char* const file : std::array{SIGS_IMAGE_CODECS_FILES})
      if (found == nullptr) found = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
    return found;
  }();
  if (opened == nullptr) {
    const char* const why = dlerror();
    stop_for(why == nullptr ? "install it" : why);
  }
  return opened;
}

// A function by its name in the library (Itanium C++ ABI); CMakeLists.txt has checked these.
template <class Function>
Function* function_named(const char* mangled_name) {
  void* const found = dlsym(library(), mangled_name);
  if (found == nullptr) stop_for(std::string("it has no ") + mangled_name);
  return reinterpret_cast<Function*>(found);
}

}  // namespace

static cv::Mat opencv_imread(const std::string& file, int flags) {
  static auto* const call = function_named<cv::Mat(const std::string&, int)>(SIGS_MANGLED_IMREAD);
  return call(file, flags);
}

cv::Mat imdecode(cv::InputArray bytes, int flags) {
  static auto* const call = function_named<cv::Mat(cv::InputArray, int)>(SIGS_MANGLED_IMDECODE);
  return call(bytes, flags);
}

bool imwrite(const std::string& file, cv::InputArray image, const std::vector<int>& parameters) {
  using Function = bool(const std::string&, cv::InputArray, const std::vector<int>&);
  static auto* const call = function_named<Function>(SIGS_MANGLED_IMWRITE);
  return call(file, image, parameters);
}

static bool opencv_imencode(const std::string& extension, cv::InputArray image, std::vector<uchar>& bytes,
                            const std::vector<int>& parameters) {
  using Function = bool(const std::string&, cv::InputArray, std::vector<uchar>&, const std::vector<int>&);
  static auto* const call = function_named<Function>(SIGS_MANGLED_IMENCODE);
  return call(extension, image, bytes, parameters);
}

#else

static cv::Mat opencv_imread(const std::string& file, int flags) {
  return cv::imread(file, flags);
}

cv::Mat imdecode(cv::InputArray bytes, int flags) {
  return cv::imdecode(bytes, flags);
}

bool imwrite(const std::string& file, cv::InputArray image, const std::vector<int>& parameters) {
  return cv::imwrite(file, image, parameters);
}

static bool opencv_imencode(const std::string& extension, cv::InputArray image, std::vector<uchar>& bytes,
                            const std::vector<int>& parameters) {
  return cv::imencode(extension, image, bytes, parameters);
}

#endif

cv::Mat imread(const std::string& file, int flags) {
  if (flags == cv::IMREAD_UNCHANGED)
    if (cv::Mat image = plain_png(file); !image.empty()) return image;
  return opencv_imread(file, flags);
}

bool imencode(const std::string& extension, cv::InputArray image, std::vector<uchar>& bytes,
              const std::vector<int>& parameters) {
  if (extension == ".png" && parameters.empty() && image.isMat())
    if (bytes = plain_png_bytes(image.getMat()); !bytes.empty()) return true;
  return opencv_imencode(extension, image, bytes, parameters);
}

}  // namespace sigs::image_codecs

namespace sigs {

Result<void> check_image_size(cv::Size size_px) {
  const bool is_large = std::max(size_px.width, size_px.height) > kMaxImageSide_px ||
                        std::int64_t{size_px.width} * size_px.height > kMaxImagePixels;
  if (!is_large) return {};
  return fail("", fmt::format("is {}; images of at most {} pixels a side and {} million in all are read",
                              image_size_text(size_px), kMaxImageSide_px, kMaxImagePixels / 1'000'000));
}

Result<cv::Mat> read_image_file(const std::filesystem::path& path, int flags) {
  if (const Result<void> file = check_input_file(path, "image"); !file) return fail(file.error());
  const std::optional<cv::Size> size_px = image_size_px(path);
  if (size_px)
    if (const Result<void> allowed = check_image_size(*size_px); !allowed)
      return fail(path.string(), allowed.error().what);
  try {
    cv::Mat image = size_px ? image_codecs::imread(path.string(), flags) : cv::Mat();
    if (!image.empty()) return image;
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
  }
  return fail(path.string(), "is not an image that can be read (png, jpeg, bmp, tiff, webp, pnm)");
}

}  // namespace sigs
