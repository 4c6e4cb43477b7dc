// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "telemetry/track.h"
#include "telemetry/track_csv.h"
#include "telemetry/track_report.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTelemetryFooter =
    "Examples:\n"
    "  sigs telemetry flight.mp4\n"
    "  sigs telemetry flight.mp4 --out flight.csv --plot flight.png\n"
    "  sigs telemetry flight.csv --gaps 100";

struct TelemetryOptions {
  fs::path file;
  fs::path csv;   // empty: none is written
  fs::path plot;  // likewise
  int gaps = 5;
  bool force = false;
};

Result<std::string> plot_of(const Track& track) {
  const cv::Mat image = track_plot(track);
  if (image.empty())
    return fail(track.file.string(), "there is no attitude, rate or place in it that --plot could draw");
  return png_bytes(image);
}

Result<void> run(const TelemetryOptions& options) {
  const std::vector<CommandOutput> outputs{{"--out", options.csv}, {"--plot", options.plot}};
  if (const Result<void> named = check_outputs(outputs, {options.file}); !named) return named;
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(outputs); !free) return free;
  const Result<Track> track = read_track(options.file, &interrupt_flag());
  if (!track) return fail(track.error());
  for (const Warning& warning : track->warnings) print_warning(warning);
  const Result<void> written = files.write_and_commit(
      {{options.csv, [&] { return track_csv_text(*track); }}, {options.plot, [&] { return plot_of(*track); }}});
  if (!written) return written;
  std::fputs(track_report_text(*track, options.gaps).c_str(), stdout);
  return {};
}

}  // namespace

Command add_telemetry_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("telemetry", "say what a flight log contains, or convert it to CSV");
  const auto options = std::make_shared<TelemetryOptions>();
  add_subject(*command, "FILE", options->file, "a flight log, or a video with telemetry in it");
  add_output(*command, "--out", options->csv, "write all of it as CSV with named columns");
  add_output(*command, "--plot", options->plot, "draw attitude, rates, height and ground track; a PNG");
  add_number(*command, "--gaps", options->gaps, "N", 0, 1000000,
             "list at most so many gaps and clock jumps of a channel");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kTelemetryFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
