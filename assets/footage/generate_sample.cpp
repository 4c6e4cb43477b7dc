// SPDX-License-Identifier: MIT
// generate_sample CALIBRATION MASK.png [FIRST LAST] writes the own body's mask and, to stdout, the frames as raw 8-bit
// Y'CbCr 4:2:0 planes for an encoder. SOURCE.md has the whole commands.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "flight.h"
#include "sensor.h"

namespace {

using namespace sigs::footage;

struct GeneratorOptions {
  std::string calibration;
  std::string mask;
  int first = 0;
  int last = -1;  // the clip's last
  std::string clip = "sample";
  int length = 0;  // frames of the clip; 0: as many as the condition has
  std::string attitudes;
  std::vector<double> mount_deg;  // roll, pitch, yaw; empty: the camera on the aircraft's back, which looks ahead
  double rate_hz = kFrameRate_hz;
  double start_s = 0;
};

void describe(CLI::App& app, GeneratorOptions& options) {
  app.add_option("CALIBRATION", options.calibration, "the lens")->required();
  app.add_option("MASK", options.mask, "PNG to write: what the own body hides")->required();
  CLI::Option* first = app.add_option("FIRST", options.first, "first frame to draw")->check(CLI::NonNegativeNumber);
  CLI::Option* last = app.add_option("LAST", options.last, "last frame to draw")->check(CLI::NonNegativeNumber);
  first->needs(last);
  app.add_option("--clip", options.clip, "sample, table1_clouds, table1_clear or table1_vibration");
  app.add_option("--length", options.length, "frames of the whole clip")->check(CLI::Range(1, 10000));
  app.add_option("--mount", options.mount_deg, "of another camera: its roll, pitch and yaw on the aircraft, degrees")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--rate", options.rate_hz, "its frames a second")->check(CLI::Range(1.0, 1000.0));
  app.add_option("--start", options.start_s, "time of its first frame in the clip, seconds")
      ->check(CLI::Range(0.0, 1000.0));
  app.add_option("--attitudes", options.attitudes, "CSV to write: the attitude at each frame of the whole clip");
}

std::optional<Condition> condition_of(const GeneratorOptions& options) {
  for (Condition condition : conditions()) {
    if (condition.name != options.clip) continue;
    if (options.length > 0) condition.frames = options.length;
    return condition;
  }
  return std::nullopt;
}

bool write_mask(const std::string& path, const cv::Mat_<float>& cover) {
  cv::Mat mask;
  cover.convertTo(mask, CV_8UC1, 255);
  try {
    return cv::imwrite(path, mask);
  } catch (const cv::Exception&) {
    return false;
  }
}

// As the project's camera.attitude_file wants it. A millionth of a degree is a hundred-thousandth of a pixel.
bool write_attitudes(const std::string& path, const Condition& condition) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  std::fputs("frame,roll_deg,pitch_deg,yaw_deg\n", file);
  for (int frame = 0; frame < condition.frames; ++frame) {
    const sigs::Attitude attitude = attitude_at(condition, frame);
    std::fprintf(file, "%d,%.6f,%.6f,%.6f\n", frame, sigs::deg_of_rad(attitude.roll_rad),
                 sigs::deg_of_rad(attitude.pitch_rad), sigs::deg_of_rad(attitude.yaw_rad));
  }
  return std::fclose(file) == 0;
}

int failed(const std::string& text, int status) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return status;
}

int write_frames(Flight& flight, const Condition& condition, int first, int last) {
  for (int frame = first; frame <= last; ++frame) {
    const auto bytes = developed(flight.light(frame), condition.exposure, frame);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) return 74;
  }
  return std::fflush(stdout) == 0 ? 0 : 74;
}

MountedCamera mounted_by(const GeneratorOptions& options) {
  MountedCamera mounted{.rate_hz = options.rate_hz, .start_s = options.start_s};
  const std::vector<double>& deg = options.mount_deg;
  if (deg.empty()) return mounted;
  mounted.mount = {sigs::rad_of_deg(deg[0]), sigs::rad_of_deg(deg[1]), sigs::rad_of_deg(deg[2])};
  mounted.shows_body = false;
  return mounted;
}

int generate(const GeneratorOptions& options) {
  const std::optional<Condition> condition = condition_of(options);
  if (!condition) return failed(options.clip + ": there is no such clip", 64);
  const int frames =
      static_cast<int>(std::floor((condition->frames / kFrameRate_hz - options.start_s) * options.rate_hz + 1e-9));
  const int last = options.last < 0 ? frames - 1 : options.last;
  if (last >= frames || options.first > last)
    return failed("the clip has the frames 0 to " + std::to_string(frames - 1), 64);
  const auto camera = sigs::read_calibration(options.calibration);
  if (!camera) return failed(camera.error().text(), 66);
  if (!options.attitudes.empty() && !write_attitudes(options.attitudes, *condition))
    return failed(options.attitudes + ": cannot be written", 73);
  Flight flight(*camera, *condition, mounted_by(options));
  if (!write_mask(options.mask, flight.body().cover)) return failed(options.mask + ": cannot be written", 73);
  return write_frames(flight, *condition, options.first, last);
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Draws the sample footage.");
  GeneratorOptions options;
  describe(app, options);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 64;
  }
  return generate(options);
}
