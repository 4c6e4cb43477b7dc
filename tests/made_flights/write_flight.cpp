// SPDX-License-Identifier: MIT
#include "made_flights/write_flight.h"

#include <fmt/format.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "made_flights/gyro_log.h"
#include "video/video_writer.h"

namespace sigs::made {

namespace fs = std::filesystem;

namespace {

Result<void> write_footage(const Flight& flight, const fs::path& file, bool lossless) {
  const VideoFormat format{.codec = lossless ? VideoCodec::ffv1 : VideoCodec::h264,
                           .container = lossless ? Container::mkv : Container::mp4,
                           .size_px = flight.camera().size_px,
                           .frame_rate_num = static_cast<int>(flight.settings().frame_rate_hz)};
  Result<VideoWriter> writer = VideoWriter::open(file, format);
  if (!writer) return fail(writer.error());
  for (int n = 0; n < flight.settings().frames; ++n)
    if (const Result<void> written = writer->write(flight.frame(n), n); !written) return written;
  return writer->finish();
}

Result<void> write_truth(const Flight& flight, const fs::path& file) {
  std::ofstream out(file);
  out << "frame,time_s,qw,qx,qy,qz,x_m,y_m,z_m\n";
  for (int n = 0; n < flight.settings().frames; ++n) {
    const double t_s = flight.time_s(n);
    const glm::dquat q = flight.motion().world_from_camera(t_s);
    const glm::dvec3 p_m = flight.motion().position_m(t_s);
    out << fmt::format("{},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f},{:.6f},{:.6f},{:.6f}\n", n, t_s, q.w, q.x, q.y, q.z,
                       p_m.x, p_m.y, p_m.z);
  }
  if (!out.flush()) return fail(file.string(), "cannot be written", ErrorKind::cannot_create);
  return {};
}

}  // namespace

Result<fs::path> write_flight(const Flight& flight, const fs::path& folder, bool lossless) {
  const fs::path footage = folder / (lossless ? "footage.mkv" : "footage.mp4"), complete = folder / "complete";
  std::error_code error;
  if (fs::exists(complete, error)) return footage;
  fs::create_directories(folder, error);
  const FlightSettings& settings = flight.settings();
  const auto samples = gyro_log(flight.motion(), settings.frames / settings.frame_rate_hz, {.seed = settings.seed});
  if (const auto written = write_gyro_log(folder / "gyro.csv", samples); !written) return fail(written.error());
  if (const auto written = write_truth(flight, folder / "truth.csv"); !written) return fail(written.error());
  if (settings.own_body && !cv::imwrite((folder / "own_body.png").string(), flight.own_body_mask()))
    return fail((folder / "own_body.png").string(), "cannot be written", ErrorKind::cannot_create);
  if (const auto written = write_footage(flight, footage, lossless); !written) return fail(written.error());
  std::ofstream(complete) << "the folder is complete\n";
  return footage;
}

}  // namespace sigs::made
