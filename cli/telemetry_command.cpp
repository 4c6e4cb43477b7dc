// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/image_codecs.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "telemetry/read_track.h"
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

// Before anything is read. Errors usage, cannot_create.
Result<void> check_names(const TelemetryOptions& options) {
  if (!options.plot.empty() && lower_extension(options.plot) != ".png")
    return fail("--plot " + options.plot.string(), "is written as PNG; end its name in .png", ErrorKind::usage);
  if (!options.csv.empty() && !options.plot.empty() && canonical_name(options.csv) == canonical_name(options.plot))
    return fail("--plot " + options.plot.string(), "is where --out goes", ErrorKind::usage);
  for (const auto& [option, path] : {std::pair("--out ", options.csv), std::pair("--plot ", options.plot)}) {
    if (path.empty()) continue;
    if (const Result<void> kept = check_inputs_not_overwritten(std::vector{path}, {options.file}); !kept)
      return fail(option + path.string(), kept.error().what, ErrorKind::cannot_create);
  }
  return {};
}

Result<std::string> png_of(const Track& track) {
  const cv::Mat image = track_plot(track);
  if (image.empty())
    return fail(track.file.string(), "there is no attitude, rate or place in it that --plot could draw");
  std::vector<uchar> bytes;
  image_codecs::imencode(".png", image, bytes);
  return std::string(bytes.begin(), bytes.end());
}

// The names are taken before the file is read, so that what stands in their way shows at once.
class Outputs {
 public:
  explicit Outputs(const TelemetryOptions& options)
      : options_(options),
        staged_(options.force ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse) {}

  Result<void> reserve() {
    for (const auto& [path, place] : {std::pair(options_.csv, &csv_), std::pair(options_.plot, &plot_)}) {
      if (path.empty()) continue;
      const Result<fs::path> added = staged_.add_file(path);
      if (!added) return fail(added.error());
      *place = *added;
    }
    return {};
  }

  Result<void> write(const Track& track) {
    if (!csv_.empty())
      if (const Result<void> done = write_bytes(csv_, track_csv_text(track)); !done)
        return fail(staged_.with_final_names(done.error()));
    if (!plot_.empty()) {
      const Result<std::string> png = png_of(track);
      if (!png) return fail(png.error());
      if (const Result<void> done = write_bytes(plot_, *png); !done)
        return fail(staged_.with_final_names(done.error()));
    }
    return staged_.commit();
  }

 private:
  const TelemetryOptions& options_;
  StagedOutputs staged_;
  fs::path csv_;  // temporary names
  fs::path plot_;
};

Result<void> telemetry(const TelemetryOptions& options) {
  if (const Result<void> named = check_names(options); !named) return named;
  defer_interrupts();
  Outputs outputs(options);
  if (const Result<void> free = outputs.reserve(); !free) return free;
  const Result<Track> track = read_track(options.file, {.cancel = &interrupt_flag()});
  if (!track) return fail(track.error());
  for (const Warning& warning : track->warnings) print_warning(warning);
  if (const Result<void> written = outputs.write(*track); !written) return written;
  std::fputs(track_report_text(*track, options.gaps).c_str(), stdout);
  return {};
}

}  // namespace

Command add_telemetry_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("telemetry", "say what a flight log contains, or convert it to CSV");
  const auto options = std::make_shared<TelemetryOptions>();
  command->add_option("FILE", options->file, "a flight log, or a video with telemetry in it")
      ->required()
      ->check(not_empty());
  command->add_option("--out", options->csv, "write all of it as CSV with named columns")
      ->option_text("FILE")
      ->check(output_path());
  command->add_option("--plot", options->plot, "draw attitude, rates, height and ground track; a PNG")
      ->option_text("FILE")
      ->check(output_path());
  command->add_option("--gaps", options->gaps, "list at most so many gaps and clock jumps of a channel")
      ->option_text("N")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kTelemetryFooter);
  return [options] { return telemetry(*options); };
}

}  // namespace sigs::cli
