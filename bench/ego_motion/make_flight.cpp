// SPDX-License-Identifier: MIT
// make_flight CASE SEED FOLDER writes one flight with its truth (tests/made_flights/write_flight.h).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "made_flights/made_cases.h"
#include "made_flights/write_flight.h"

namespace {

struct Options {
  std::string kind, folder, calibration = SIGS_ASSETS_DIR "/calibrations/sample.xml";
  std::uint32_t seed = 1;
  int width = 640, height = 480, frames = 250;
  bool lossless = false;
};

void describe(CLI::App& app, Options& options) {
  app.add_option("CASE", options.kind, "calm, vibrating, turning, \"rolling shutter\", \"own body\", clouds or water")
      ->required();
  app.add_option("SEED", options.seed, "any number; odd ones are for tuning")->required();
  app.add_option("FOLDER", options.folder, "folder to write")->required();
  app.add_option("--calibration", options.calibration, "the lens");
  app.add_option("--width", options.width, "px")->check(CLI::Range(32, 4096));
  app.add_option("--height", options.height, "px")->check(CLI::Range(32, 4096));
  app.add_option("--frames", options.frames, "at 25 a second")->check(CLI::Range(1, 10000));
  app.add_flag("--lossless", options.lossless, "FFV1 instead of H.264 with CRF 18");
}

int failed(const std::string& text, int status) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return status;
}

int make(const Options& options) {
  const auto camera = sigs::read_calibration(options.calibration, cv::Size(options.width, options.height));
  if (!camera) return failed(camera.error().text(), 66);
  auto settings = sigs::made::case_by_name(options.kind, options.seed, *camera);
  if (!settings) return failed(options.kind + ": there is no such case", 64);
  settings->frames = options.frames;
  const sigs::made::Flight flight(*settings, *camera);
  const auto footage = sigs::made::write_flight(flight, options.folder, options.lossless);
  if (!footage) return failed(footage.error().text(), 73);
  std::printf("%s\nmoving share of the image: %.2f\n", footage->c_str(), flight.moving_share(options.frames / 2));
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Writes synthetic footage of a flight, with the exact attitude of its camera.");
  Options options;
  describe(app, options);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 64;
  }
  return make(options);
}
