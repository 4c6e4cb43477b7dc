// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "appearance/appearance.h"
#include "base/json.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "comparison/lit_like.h"
#include "first_project/first_project.h"
#include "project/fields.h"
#include "project/json.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kAppearanceFooter =
    "Examples:\n"
    "  sigs appearance flight.mp4\n"
    "  sigs appearance flight.mp4 --out settings.json --plot appearance.png\n"
    "  sigs appearance encounter.json --into encounter.json\n"
    "  sigs appearance encounter.json --lit-like 312,204,36,24 --frame 100 --into encounter.json";

struct AppearanceOptions {
  fs::path file;
  SequenceTiming timing;  // of images
  std::string frames;     // "A-B"; empty: all
  int every = 0;
  fs::path out;   // empty: not written
  fs::path plot;  // likewise
  fs::path into;
  std::string camera;    // of a rig
  std::string lit_like;  // "X,Y,W,H"; empty: the look of the footage is found
  std::optional<int> frame;
  bool json = false;
  bool force = false;
  std::string progress = "auto";
};

std::vector<CommandOutput> outputs_of(const AppearanceOptions& options) {
  return {{"--out", options.out}, {"--plot", options.plot}};
}

// Which frames are looked at.
Result<AppearanceFrames> frames_of(const AppearanceOptions& options, const std::optional<Project>& project) {
  AppearanceFrames frames{.every = options.every};
  if (project) {
    frames.first = project->footage.first_frame;
    frames.last = project->footage.last_frame;
  }
  const Result<std::optional<FrameRange>> range = frame_range_of(options.frames);
  if (!range) return fail(range.error());
  if (!*range) return frames;
  frames.first = (*range)->first;
  frames.last = (*range)->last;
  return frames;
}

Result<Appearance> found_in(const AppearanceFrames& frames, const std::optional<Project>& project,
                            const AppearanceOptions& options) {
  Progress progress(options.progress);
  const AppearanceControl control{.progress = progress.counter(), .cancel = &interrupt_flag(), .warn = print_warning};
  if (project) return appearance_of_footage(*project, frames, is_still_guessed(*project, "camera.position_m"), control);
  Result<FrameSource> footage = FrameSource::open(options.file, &interrupt_flag(), Quantisers::read, options.timing);
  if (!footage) return fail(footage.error());
  for (const Warning& warning : footage->info().warnings) print_warning(warning);
  return estimate_appearance(*footage, frames, {}, control);
}

// What apply() sets, by its keys, nested as in a project file.
template <class Found>
Json settings_of(const Found& found) {
  Project project;
  apply(found, project);
  return settings_json(std::move(project), applied_settings(found));
}

std::string settings_lines(const Json& settings, const std::vector<std::string>& keys) {
  std::string text = "\nsettings:\n";
  for (const std::string& key : keys) text += fmt::format("{} = {}\n", key, settings.at(pointer_of(key)).dump());
  return text;
}

Json quantities_json(const std::vector<AppearanceQuantity>& quantities) {
  Json all = Json::array();
  for (const AppearanceQuantity& quantity : quantities) {
    const Estimate& estimate = quantity.estimate;
    all.push_back({{"name", quantity.name},
                   {"unit", quantity.unit},
                   {"value", estimate.value},
                   {"sd", estimate.is_known ? Json(estimate.sd) : Json()},
                   {"is_known", estimate.is_known},
                   {"why", estimate.why},
                   {"how", quantity.how},
                   {"setting", quantity.setting.empty() ? Json() : Json(quantity.setting)}});
  }
  return all;
}

std::string lines_of(const std::vector<AppearanceQuantity>& quantities) {
  std::size_t widest = 0;
  for (const AppearanceQuantity& quantity : quantities) widest = std::max(widest, quantity.name.size());
  std::string text;
  for (const AppearanceQuantity& quantity : quantities)
    text += fmt::format("{:{}}  {}\n", quantity.name, widest, text_of(quantity));
  return text;
}

// Everything, for programs.
std::string report_json(const Appearance& found) {
  Json report;
  report["video"] = found.footage.path.string();
  report["width_px"] = found.footage.size_px.width;
  report["height_px"] = found.footage.size_px.height;
  report["codec"] = found.footage.codec;
  report["frames_used"] = found.frames_used;
  report["quantities"] = quantities_json(quantities_of(found));
  report["settings"] = settings_of(found);
  return json_text(report);
}

std::string table_text(const Appearance& found) {
  std::string text =
      fmt::format("{}: {}, {}, {} used\n", found.footage.path.string(), image_size_text(found.footage.size_px),
                  found.footage.codec, count_text(found.frames_used, "frame"));
  text += lines_of(quantities_of(found));
  return text + settings_lines(settings_of(found), applied_settings(found));
}

// Puts what was found into the project of --into, where there is one.
template <class Found>
Result<void> write_into(const Found& found, std::optional<Project>& into, const AppearanceOptions& options) {
  if (!into) return {};
  apply(found, *into);
  if (const Result<void> saved = rewrite_project(*into, options.into); !saved) return saved;
  std::fprintf(stderr, "written into %s\n", options.into.c_str());
  return {};
}

Result<void> find_light(const Project& project, std::optional<Project>& into, const AppearanceOptions& options,
                        OutputFiles& files) {
  const Result<Box> box = box_of_option("--lit-like", options.lit_like);
  if (!box) return fail(box.error());
  if (!options.frame) return fail("--lit-like", "is in one frame; name it with --frame", ErrorKind::usage);
  Progress progress(options.progress);
  const LitLikeControl control{.progress = progress.counter(), .cancel = &interrupt_flag()};
  const Result<LitLike> lit = lit_like(project, *options.frame, *box, control);
  progress.end();
  if (!lit) return fail(lit.error());
  const Json settings = settings_of(*lit);
  const Result<void> saved = files.write_and_commit({{options.out, [&] { return json_text(settings); }}});
  if (!saved) return saved;
  if (const Result<void> written = write_into(*lit, into, options); !written) return written;
  const Json report{{"quantities", quantities_json(quantities_of(*lit))}, {"settings", settings}};
  const std::string text = options.json
                               ? json_text(report)
                               : lines_of(quantities_of(*lit)) + settings_lines(settings, applied_settings(*lit));
  std::fputs(text.c_str(), stdout);
  return {};
}

Result<void> find_look(const std::optional<Project>& project, std::optional<Project>& into,
                       const AppearanceOptions& options, OutputFiles& files) {
  const Result<AppearanceFrames> frames = frames_of(options, project);
  if (!frames) return fail(frames.error());
  const Result<Appearance> found = found_in(*frames, project, options);
  if (!found) return fail(found.error());
  const Result<void> saved =
      files.write_and_commit({{options.out, [&] { return json_text(settings_of(*found)); }},
                              {options.plot, [&] { return png_bytes(panel_page(panels_of(*found))); }}});
  if (!saved) return saved;
  if (const Result<void> written = write_into(*found, into, options); !written) return written;
  std::fputs((options.json ? report_json(*found) : table_text(*found)).c_str(), stdout);
  return {};
}

// What --lit-like does not go with.
Result<void> check_lit_like(const AppearanceOptions& options) {
  if (options.lit_like.empty())
    return options.frame ? fail("--frame", "goes with --lit-like", ErrorKind::usage) : Result<void>();
  if (!is_project_file(options.file))
    return fail("--lit-like", "needs a project, whose intruder is to be lit", ErrorKind::usage);
  if (!options.plot.empty() || !options.frames.empty() || options.every != 0)
    return fail("--lit-like", "looks at one frame; leave --plot, --frames and --every out", ErrorKind::usage);
  return {};
}

Result<void> run(const AppearanceOptions& options) {
  tune_allocator();
  std::vector<fs::path> inputs{options.file};
  if (!options.into.empty()) inputs.push_back(options.into);
  if (const Result<void> named = check_outputs(outputs_of(options), inputs); !named) return named;
  if (const Result<void> fits = check_lit_like(options); !fits) return fits;
  const auto read_into = [&](const fs::path& file, std::optional<Project>& project) -> Result<void> {
    Result<Project> read = project_of({.file = file, .settings = {}, .camera = options.camera});
    if (!read) return fail(read.error());
    project = std::move(*read);
    return {};
  };
  std::optional<Project> project;
  std::optional<Project> into;
  if (is_project_file(options.file)) {
    if (options.timing != SequenceTiming{})
      return fail(options.timing.times_file.empty() ? "--frame-rate" : "--timestamps",
                  "is stated by the project; leave it out", ErrorKind::usage);
    if (const Result<void> read = read_into(options.file, project); !read) return read;
  }
  if (!options.into.empty())
    if (const Result<void> read = read_into(options.into, into); !read) return read;
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(outputs_of(options)); !free) return free;
  return options.lit_like.empty() ? find_look(project, into, options, files)
                                  : find_light(*project, into, options, files);
}

}  // namespace

Command add_appearance_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("appearance", "find how footage looks: blur, noise, haze, light");
  const auto options = std::make_shared<AppearanceOptions>();
  add_subject(*command, "FILE", options->file, "the footage, or a project");
  add_value(*command, "--frames", options->frames, "A-B", "only these frames, first and last, both included");
  add_number(*command, "--every", options->every, "N", 0, 1000000,
             "use one of so many frames; 0: 24 frames, spread over all");
  add_timing_options(*command, options->timing);
  add_camera_option(*command, options->camera);
  add_output(*command, "--out", options->out, "write the settings that follow, as JSON");
  add_input(*command, "--into", options->into, "put the settings into this project, which is rewritten", "PROJECT");
  add_value(*command, "--lit-like", options->lit_like, "X,Y,W,H",
            "instead: the exposure with which the project's intruder is as bright as what is in this box of --frame");
  add_value(*command, "--frame", options->frame, "N", "the frame of --lit-like, from 0")
      ->check(CLI::Range(0, 10'000'000));
  add_output(*command, "--plot", options->plot, "draw why; a PNG");
  command->add_flag("--json", options->json, "print all of it as JSON");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kAppearanceFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
