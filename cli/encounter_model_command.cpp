// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "encounter_model/model_flight.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEncounterModelFooter =
    "Examples:\n"
    "  sigs encounter-model uncor_1200only_fwse_v1p2.txt\n"
    "  sigs encounter-model glider_v1.txt --samples 100 --seed 7 --duration 120 --out tracks.csv --plot tracks.png";

constexpr std::size_t kMaxDrawn = 200;  // lines of a plot that can be followed at all

struct EncounterModelOptions {
  fs::path file;
  int samples = 10;
  std::int64_t seed = 1;
  ModelFlightSettings track{.max_redraws = 100};
  fs::path csv;   // empty: none is written
  fs::path plot;  // likewise
  bool force = false;
};

std::vector<CommandOutput> outputs_of(const EncounterModelOptions& options) {
  return {{"--out", options.csv}, {"--plot", options.plot}};
}

// What was drawn, for the report and the plot.
struct DrawnFlights {
  std::vector<ModelFlight> first;  // at most kMaxDrawn
  std::int64_t redraws = 0;
  std::int64_t outside = 0;
};

// Draws all flights, each with a stream of its own, and writes them as they come. Errors interrupted, write_failed.
//   csv  under its temporary name; empty: not written
Result<DrawnFlights> drawn_flights(const EncounterModel& model, const EncounterModelOptions& options,
                                   const fs::path& csv) {
  std::ofstream out;
  if (!csv.empty()) out.open(csv, std::ios::binary);
  if (out.is_open()) out << track_csv_header(model);
  DrawnFlights drawn;
  for (int number = 0; number < options.samples && out; ++number) {
    if (interrupt_flag()) return fail("", "interrupted", ErrorKind::interrupted);
    Random random(static_cast<std::uint64_t>(options.seed), static_cast<std::uint64_t>(number));
    ModelFlight track = drawn_flight(model, options.track, random);
    drawn.redraws += track.redraws;
    drawn.outside += track.is_within_limits ? 0 : 1;
    if (out.is_open()) out << track_csv_rows(track, number, model);
    if (drawn.first.size() < kMaxDrawn) drawn.first.push_back(std::move(track));
  }
  if (out.is_open()) out.close();
  if (!out)
    return fail(csv.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return drawn;
}

void print_drawn(const DrawnFlights& drawn, const EncounterModelOptions& options) {
  std::printf("drawn: %s of %d s with seed %lld, %s discarded since they left the model's limits\n",
              count_text(options.samples, "flight").c_str(), options.track.duration_s,
              static_cast<long long>(options.seed), count_text(drawn.redraws, "other").c_str());
  if (drawn.outside > 0)
    print_warning({"", count_text(drawn.outside, "flight") +
                           " left the model's limits (below altitude 0, or beyond the speeds of v) in every try"});
  if (!options.plot.empty() && static_cast<std::size_t>(options.samples) > kMaxDrawn)
    print_warning({options.plot.string(), "shows the first " + std::to_string(kMaxDrawn) + " flights"});
}

// The flights, written under names that are taken before.
Result<void> draw(const EncounterModel& model, const EncounterModelOptions& options) {
  if (const Result<void> flies = check_can_fly(model); !flies) return fail(options.file.string(), flies.error().what);
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(outputs_of(options)); !free) return free;
  const Result<DrawnFlights> drawn =
      drawn_flights(model, options, options.csv.empty() ? fs::path() : files.staged(options.csv));
  if (!drawn) return fail(files.with_final_names(drawn.error()));
  const Result<void> written =
      files.write_and_commit({{options.plot, [&] { return png_bytes(flights_plot(drawn->first)); }}});
  if (!written) return written;
  print_drawn(*drawn, options);
  return {};
}

Result<void> run(const EncounterModelOptions& options) {
  if (const Result<void> named = check_outputs(outputs_of(options), {options.file}); !named) return named;
  const Result<EncounterModel> model = read_encounter_model(options.file);
  if (!model) return fail(model.error());
  for (const Warning& warning : model->warnings) print_warning(warning);
  std::fputs(model_report_text(*model).c_str(), stdout);
  if (options.csv.empty() && options.plot.empty()) return {};
  return draw(*model, options);
}

}  // namespace

Command add_encounter_model_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("encounter-model", "say what a statistical model of flights contains, and draw flights");
  const auto options = std::make_shared<EncounterModelOptions>();
  add_subject(*command, "FILE", options->file, "a model as MIT Lincoln Laboratory publishes them: a text file");
  add_number(*command, "--samples", options->samples, "N", 1, 10'000'000,
             "number of flights that are drawn for --out and --plot");
  add_number(*command, "--seed", options->seed, "S", std::int64_t{0}, std::numeric_limits<std::int64_t>::max(),
             "the same seed gives the same flights");
  add_number(*command, "--duration", options->track.duration_s, "S", 1, 86400, "whole seconds that each flight lasts");
  add_number(*command, "--redraws", options->track.max_redraws, "N", 0, 1'000'000,
             "draw a flight that leaves the model's limits anew, at most so often");
  add_output(*command, "--out", options->csv, "write the flights as CSV with named columns, a line for each second");
  add_output(*command, "--plot", options->plot, "draw the flights from above and over time; a PNG");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kEncounterModelFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
