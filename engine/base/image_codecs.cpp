// SPDX-License-Identifier: MIT
#include "base/image_codecs.h"

#include <dlfcn.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "base/png.h"

namespace sigs::image_codecs {

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
