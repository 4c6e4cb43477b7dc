// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "base/pose.h"
#include "ego_motion/measures.h"
#include "made_flights/gyro_log.h"
#include "made_flights/made_cases.h"
#include "made_flights/write_flight.h"
#include "video/frame_source.h"

namespace sigs::bench {

namespace {

// The log as the program sees it: its own time axis, rates about the camera's axes.
Track gyro_track(const made::Flight& flight) {
  const made::FlightSettings& settings = flight.settings();
  Track track{.file = "gyro.csv", .format = "CSV"};
  track.camera_rate_radps = {.source = "gyro", .clock = "log"};
  for (const made::GyroSample& sample :
       made::gyro_log(flight.motion(), settings.frames / settings.frame_rate_hz, {.seed = settings.seed})) {
    track.camera_rate_radps.times_s.push_back(sample.stamp_s);
    track.camera_rate_radps.values.push_back(sample.camera_rate_radps);
  }
  return track;
}

// Of all threads; the wall-clock time of a busy machine tells little.
double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double decoding_s(const std::filesystem::path& footage) {
  Result<FrameSource> source = FrameSource::open(footage);
  if (!source) accuracy::stop(source.error().text());
  const double start_s = processor_s();
  for (int n = 0; n < source->info().frame_count(); ++n)
    if (const auto frame = source->read(n); !frame) accuracy::stop(frame.error().text());
  return processor_s() - start_s;
}

void add_score(Measured& result, const made::Flight& flight) {
  std::vector<glm::dquat> truth;
  made::EstimatedAttitudes estimate;
  for (std::size_t n = 0; n < result.motion.frames.size(); ++n) {
    truth.push_back(flight.motion().world_from_camera(flight.time_s(static_cast<int>(n))));
    estimate.world_from_camera.push_back(result.motion.frames[n].world_from_camera);
    estimate.sd_rad.push_back(result.motion.frames[n].sd_rad);
  }
  result.score = made::slip_score(flight.camera(), truth, estimate);
  const std::size_t middle = truth.size() / 2;
  const glm::dvec3 down{0, 0, 1};
  result.level_error_rad =
      angle_between(glm::conjugate(truth[middle]) * down, glm::conjugate(estimate.world_from_camera[middle]) * down);
}

}  // namespace

MadeFlight made_flight(const accuracy::Call& call, const std::string& kind, std::uint32_t seed) {
  const cv::Size size_px = call.quick ? cv::Size(320, 240) : cv::Size(640, 480);
  const auto camera = read_calibration(SIGS_ASSETS_DIR "/calibrations/sample.xml", size_px);
  if (!camera) accuracy::stop(camera.error().text());
  made::FlightSettings settings = made::case_by_name(kind, seed, *camera).value();
  if (call.quick) settings.frames = 30;
  std::string id = kind + "-" + std::to_string(seed);
  std::replace(id.begin(), id.end(), ' ', '-');
  made::Flight flight(settings, *camera);
  const auto footage = made::write_flight(flight, call.folder / id, false);
  if (!footage) accuracy::stop(footage.error().text());
  return {std::move(flight), *footage, id};
}

std::optional<Measured> measured(const MadeFlight& made, bool with_gyro, const EgoMotionSettings& settings) {
  Result<FrameSource> source = FrameSource::open(made.footage);
  if (!source) accuracy::stop(source.error().text());
  EgoMotionSettings own = settings;
  own.readout_s = made.flight.settings().readout_s;
  const cv::Mat body = made.flight.settings().own_body ? made.flight.own_body_mask() : cv::Mat();
  const Track track = gyro_track(made.flight);
  const double start_s = processor_s();
  auto motion = estimate_ego_motion(*source, made.flight.camera(), body, with_gyro ? &track : nullptr, own, {});
  if (!motion) {
    std::printf("%s: %s\n", made.id.c_str(), motion.error().text().c_str());
    return std::nullopt;
  }
  Measured result{.motion = std::move(*motion), .run_s = processor_s() - start_s, .decode_s = decoding_s(made.footage)};
  for (const Warning& warning : result.motion.warnings)
    std::fprintf(stderr, "%s: %s\n", made.id.c_str(), warning.text().c_str());
  add_score(result, made.flight);
  return result;
}

}  // namespace sigs::bench
