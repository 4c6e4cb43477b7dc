// SPDX-License-Identifier: MIT
// generate_sample CALIBRATION MASK.png [FIRST LAST] writes the own body's mask and, to stdout, the frames as raw 8-bit
// Y'CbCr 4:2:0 planes for an encoder. SOURCE.md has the whole command.
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "flight.h"
#include "sensor.h"

namespace {

bool write_mask(const char* path, const cv::Mat_<float>& cover) {
  cv::Mat mask;
  cover.convertTo(mask, CV_8UC1, 255);
  try {
    return cv::imwrite(path, mask);
  } catch (const cv::Exception&) {
    return false;
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3 && count != 5) {
    std::fprintf(stderr, "usage: generate_sample CALIBRATION MASK.png [FIRST LAST]\n");
    return 64;
  }
  const auto camera = sigs::read_calibration(arguments[1]);
  if (!camera) {
    std::fprintf(stderr, "%s\n", camera.error().text().c_str());
    return 66;
  }
  const sigs::footage::Flight flight(*camera);
  if (!write_mask(arguments[2], flight.body().cover)) {
    std::fprintf(stderr, "%s: cannot be written\n", arguments[2]);
    return 73;
  }
  const int first = count == 5 ? std::atoi(arguments[3]) : 0;
  const int last = count == 5 ? std::atoi(arguments[4]) : sigs::footage::kFrames - 1;
  for (int frame = first; frame <= last; ++frame) {
    const auto bytes = sigs::footage::developed(flight.light(frame), frame);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) return 74;
  }
  return std::fflush(stdout) == 0 ? 0 : 74;
}
