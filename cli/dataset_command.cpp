// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/paths.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/dataset_command.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "dataset/coverage.h"
#include "dataset/footage_cache.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"
#include "dataset/run.h"

namespace sigs::cli {

namespace {

constexpr const char* kDatasetFooter =
    "Examples:\n"
    "  sigs dataset projects/table1/table1.json --dry-run\n"
    "  sigs dataset projects/table1/table1.json --out table1\n"
    "  sigs dataset projects/table1/table1.json --out table1 --resume --set export.video.codec=h264\n"
    "  sigs dataset projects/table1/table1.json --out table1 --resume --shard 2/8\n"
    "  sigs dataset projects/table1/table1.json --out table1 --merge\n"
    "  sigs dataset projects/table1/table1.json --out table1 --coverage\n"
    "  sigs dataset projects/table1/table1.json --domain domain.json --fill more.json\n"
    "  sigs dataset table1 --data-sheet";

struct DatasetOptions {
  std::filesystem::path recipe;
  std::filesystem::path folder;  // empty: the dataset's name
  ProjectOptions project;        // --set
  int jobs = 0;
  bool resume = false;
  std::string shard;
  std::string only;  // names, separated by commas
  bool merge = false;
  bool dry_run = false;
  bool coverage = false;
  std::filesystem::path domain;  // a design domain; empty: the coverage has its own bins
  bool data_sheet = false;
  DomainFiles files;  // --json, --plot, --fill and --force
  std::string progress = "auto";
};

// Prints the table and writes the files; either all of these get their names or none.
Result<void> report_coverage(const Coverage& coverage, const std::string& title, const DatasetOptions& options) {
  const std::filesystem::path &json = options.files.json, &plot = options.files.plot;
  if (const Result<void> named = check_outputs({{"--json", json}, {"--plot", plot}}, {}); !named) return named;
  OutputFiles files(options.files.force);
  const Result<void> done = files.write_and_commit({{json, [&] { return coverage_json(coverage, title); }},
                                                    {plot, [&] { return png_bytes(coverage_plot(coverage, title)); }}});
  if (!done) return done;
  std::fputs(coverage_text(coverage, title).c_str(), stdout);
  return {};
}

// "2/3"
Result<Shard> shard_of(const std::string& text) {
  const std::optional<std::pair<int, int>> shard = fraction_of(text);
  if (shard && shard->first >= 1 && shard->first <= shard->second) return Shard{shard->first, shard->second};
  return fail("--shard " + text, "expected I/N with I from 1 to N, as in 2/3", ErrorKind::usage);
}

// What several videos have in common is printed once.
class ConsoleReporter {
 public:
  explicit ConsoleReporter(const std::string& style) : style_(style), progress_(style) {}

  [[nodiscard]] DatasetControl control() {
    return {.progress =
                [this](int done, int total) {
                  begin("videos");
                  if (done > 0) progress_.update(done, total);
                },
            .measuring =
                [this](int done, int total, const std::string& clip) {
                  begin("measuring");
                  progress_.update(done, total, "measuring how " + clip + " looks");
                },
            .warn =
                [this](const Warning& warning) {
                  if (!printed_.insert(warning.what).second) return;
                  progress_.end();
                  print_warning(warning);
                },
            .cancel = &interrupt_flag()};
  }
  void end() { progress_.end(); }

 private:
  // What has a bar and a clock of its own.
  void begin(const std::string& part) {
    if (!part_.empty() && part != part_) {
      progress_.end();
      progress_ = Progress(style_);
    }
    part_ = part;
  }

  std::string style_;
  Progress progress_;
  std::string part_;
  std::set<std::string> printed_;
};

std::set<std::string> names_in(const std::string& comma_separated) {
  std::set<std::string> names;
  std::istringstream text(comma_separated);
  for (std::string name; std::getline(text, name, ',');) names.insert(name);
  return names;
}

// Leaves the named videos in the plan. An unknown name is the command line's fault.
Result<void> keep_only(Plan& plan, const std::set<std::string>& names) {
  std::set<std::string> unknown = names;
  for (const PlannedVideo& video : plan.videos) unknown.erase(video.name);
  for (const ImpossibleVideo& video : plan.impossible) unknown.erase(video.name);
  for (const VideoFailure& unopened : plan.unopened) unknown.erase(unopened.video);
  if (!unknown.empty())
    return fail("--only " + *unknown.begin(), "the recipe has no such video; --dry-run lists them", ErrorKind::usage);
  std::erase_if(plan.videos, [&](const PlannedVideo& video) { return !names.contains(video.name); });
  std::erase_if(plan.impossible, [&](const ImpossibleVideo& video) { return !names.contains(video.name); });
  std::erase_if(plan.unopened, [&](const VideoFailure& unopened) { return !names.contains(unopened.video); });
  return {};
}

// The recipe, with its warnings printed.
Result<Recipe> recipe_of(const DatasetOptions& options) {
  Result<ReadRecipe> read = read_recipe(options.recipe, options.project.settings);
  if (!read && read.error().kind == ErrorKind::usage)  // an assignment of --set
    return fail("--set " + read.error().where, read.error().what, ErrorKind::usage);
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  return std::move(read->recipe);
}

Result<Plan> planned(const Recipe& recipe, const DatasetOptions& options) {
  Result<Plan> plan = plan_of(recipe, &interrupt_flag());
  if (!plan || options.only.empty()) return plan;
  if (const Result<void> kept = keep_only(*plan, names_in(options.only)); !kept) return fail(kept.error());
  return plan;
}

// Impossible videos are an error of the recipe, whatever else has been done.
Result<void> check_impossible(const Plan& plan, const std::filesystem::path& recipe) {
  for (const ImpossibleVideo& video : plan.impossible)
    print_error({video.name, video.why + "; nothing is generated for it", ErrorKind::bad_data});
  if (plan.impossible.empty()) return {};
  const bool is_all = plan.videos.empty() && plan.unopened.empty();
  return fail(recipe.string(),
              is_all ? "none of its videos can be; nothing is made"
                     : count_text(plan.impossible.size(), "video") + " cannot be; the others are planned",
              ErrorKind::bad_data);
}

void warn_of_unseen(const std::vector<const PlannedVideo*>& videos,
                    const std::vector<std::optional<Visibility>>& visibilities) {
  constexpr std::size_t kNamed = 20;
  std::size_t count = 0;
  std::string names;
  for (std::size_t i = 0; i < videos.size(); ++i)
    if (visibilities[i] && visibilities[i]->visible == 0 && ++count <= kNamed)
      names += (count > 1 ? ", " : "") + videos[i]->name;
  if (count > 0)
    print_warning({"", fmt::format("the intruder is never in the image in {}: {}{}", count_text(count, "video"), names,
                                   count > kNamed ? ", ..." : "")});
}

// What the planned videos cover: of the design domain, where one is given.
Result<void> print_predicted(const Recipe& recipe, const std::vector<const PlannedVideo*>& videos,
                             const DatasetOptions& options) {
  if (!options.domain.empty()) {
    const Result<DesignDomain> domain = read_domain(options.domain);
    if (!domain) return fail(domain.error());
    const Result<DomainCoverage> coverage = predicted_domain_coverage(*domain, videos, &interrupt_flag());
    if (!coverage) return fail(coverage.error());
    return report_domain(*coverage, "predicted", options.files, &recipe, options.project.settings);
  }
  const Result<Coverage> coverage = predicted_coverage(videos, &interrupt_flag());
  if (!coverage) return fail(coverage.error());
  return report_coverage(*coverage, "predicted", options);
}

// The table, and the errors of the request.
Result<void> list(const Recipe& recipe, const Plan& plan, const std::vector<const PlannedVideo*>& videos,
                  const std::vector<std::optional<Visibility>>& visibilities, const DatasetOptions& options) {
  const Result<std::string> table = table_of(videos, visibilities);
  if (!table) return fail(table.error());
  std::fputs(table->c_str(), stdout);
  if (!options.merge && !videos.empty()) {
    std::fputs("\n", stdout);
    if (const Result<void> done = print_predicted(recipe, videos, options); !done) return done;
  }
  if (std::fflush(stdout) != 0) return fail("stdout", "could not be written", ErrorKind::write_failed);
  warn_of_unseen(videos, visibilities);
  const Result<void> possible = check_impossible(plan, options.recipe);
  if (plan.unopened.empty()) return possible;
  for (const VideoFailure& unopened : plan.unopened)
    print_error({unopened.video, unopened.error.text(), unopened.error.kind});
  return fail("", count_text(plan.unopened.size(), "video") + " cannot be made", plan.unopened.front().error.kind);
}

Result<void> print_report(const DatasetReport& report) {
  print_written(report.written);
  const double rate = report.frames / std::max(report.seconds, 1e-6);
  std::fprintf(stderr, "%s made, %d kept; %d frames in %s, %.1f frames/s\n",
               count_text(static_cast<std::size_t>(report.exported), "video").c_str(), report.kept, report.frames,
               clock_text(report.seconds).c_str(), rate);
  if (!report.checksum.empty()) std::fprintf(stderr, "checksum of all: %s\n", report.checksum.c_str());
  for (const VideoFailure& failure : report.failures)
    print_error({failure.video, failure.error.text(), failure.error.kind});
  if (report.failures.empty()) return {};
  return fail("", count_text(report.failures.size(), "video") + " failed, so there is no index; --resume tries again",
              report.failures.front().error.kind);
}

// The dataset that was made: RECIPE itself where it is a folder, else --out or the recipe's name.
Result<std::filesystem::path> made_folder(const DatasetOptions& options) {
  if (is_folder(options.recipe)) return options.recipe;
  if (!options.folder.empty()) return options.folder;
  const Result<ReadRecipe> read = read_recipe(options.recipe);
  if (!read) return fail(read.error());
  return read->recipe.name;
}

// What it covers: of the design domain, where one is given.
Result<void> print_counted(const DatasetOptions& options) {
  if (options.dry_run) return fail("--coverage", "counts what was made; --dry-run predicts it", ErrorKind::usage);
  const Result<std::filesystem::path> folder = made_folder(options);
  if (!folder) return fail(folder.error());
  if (options.domain.empty()) {
    const Result<Coverage> coverage = counted_coverage(*folder, &interrupt_flag());
    if (!coverage) return fail(coverage.error());
    return report_coverage(*coverage, "counted from the labels", options);
  }
  const Result<DesignDomain> domain = read_domain(options.domain);
  if (!domain) return fail(domain.error());
  const Result<DomainCoverage> coverage = counted_domain_coverage(*domain, *folder, &interrupt_flag());
  if (!coverage) return fail(coverage.error());
  if (options.files.fill.empty())
    return report_domain(*coverage, "counted from the labels", options.files, nullptr, {});
  const Result<Recipe> recipe = recipe_of(options);
  if (!recipe) return fail(recipe.error());
  return report_domain(*coverage, "counted from the labels", options.files, &*recipe, options.project.settings);
}

Result<void> make_sheet(const DatasetOptions& options) {
  const Result<std::filesystem::path> folder = made_folder(options);
  if (!folder) return fail(folder.error());
  const bool is_recipe = !is_folder(options.recipe);
  return write_data_sheet(*folder, is_recipe ? options.recipe : std::filesystem::path(), options.files.force);
}

// A folder as RECIPE, and options that do not go together.
Result<void> check_modes(const DatasetOptions& options) {
  const auto& [json, plot, fill, force] = options.files;
  std::error_code code;
  const bool is_made = is_folder(options.recipe);
  const bool counts = options.coverage || options.data_sheet;
  if (options.data_sheet && (options.coverage || options.dry_run || !options.domain.empty()))
    return fail("--data-sheet", "describes a dataset that was made; it goes alone", ErrorKind::usage);
  if (is_made && (!options.folder.empty() || options.dry_run || !(counts || !options.domain.empty())))
    return fail(options.recipe.string(),
                "is a folder: a dataset that was made goes with --coverage, --domain or --data-sheet, without --out; "
                "give the recipe's file for all else",
                std::filesystem::exists(options.recipe / kIndexName, code) ? ErrorKind::usage : ErrorKind::cannot_read);
  if (!fill.empty() && (options.domain.empty() || is_made))
    return fail("--fill",
                is_made ? "needs the recipe, in whose folder its paths start: sigs dataset RECIPE --out DIR --coverage "
                          "--domain FILE --fill FILE"
                        : "fills what a design domain lacks: give --domain FILE",
                ErrorKind::usage);
  if (!fill.empty() && (!options.shard.empty() || !options.only.empty()))
    return fail("--fill", "looks at all videos, so it goes without --shard and --only", ErrorKind::usage);
  if (!options.domain.empty() && options.merge) return fail("--domain", "goes without --merge", ErrorKind::usage);
  const bool has_files = !json.empty() || !plot.empty();
  const bool shows_coverage = options.coverage || !options.domain.empty() || (options.dry_run && !options.merge);
  if (has_files && !shows_coverage)
    return fail(json.empty() ? "--plot" : "--json", "goes with --dry-run, without --merge, with --coverage or --domain",
                ErrorKind::usage);
  if (force && !has_files && fill.empty() && !options.data_sheet)
    return fail("--force",
                "replaces the files of --json, --plot, --fill and --data-sheet; videos are made anew by another --out",
                ErrorKind::usage);
  return {};
}

Result<void> run(const DatasetOptions& options) {
  if (options.merge && (options.resume || !options.shard.empty() || !options.only.empty()))
    return fail("--merge", "exports nothing, so it goes without --resume, --shard and --only", ErrorKind::usage);
  if (!options.shard.empty() && !options.only.empty())
    return fail("--only", "names the videos to make, so it goes without --shard", ErrorKind::usage);
  if (const Result<void> fit = check_modes(options); !fit) return fit;
  if (options.data_sheet) return make_sheet(options);
  if (options.coverage || (is_folder(options.recipe) && !options.domain.empty())) return print_counted(options);
  DatasetRequest request{
      .jobs = options.jobs, .resume = options.resume, .index = options.only.empty(), .merge_only = options.merge};
  if (!options.shard.empty()) {
    const Result<Shard> shard = shard_of(options.shard);
    if (!shard) return fail(shard.error());
    request.shard = *shard;
  }
  const Result<Recipe> recipe = recipe_of(options);
  if (!recipe) return fail(recipe.error());
  request.source = {.program = std::string("sigs ") + SIGS_VERSION,
                    .seed = recipe->seed,
                    .recipe = recipe->text,
                    .settings = options.project.settings};
  const Result<Plan> plan = planned(*recipe, options);
  if (!plan) return fail(plan.error());
  const std::vector<const PlannedVideo*> videos = videos_of(*plan, request.shard.value_or(Shard{}));
  std::vector<std::optional<Visibility>> visibilities;
  if (!options.merge) visibilities = visibilities_of(videos, kVisibilityFrames, &interrupt_flag());
  if (options.dry_run || !options.domain.empty()) {
    if (options.merge) visibilities.resize(videos.size());
    return list(*recipe, *plan, videos, visibilities, options);
  }
  if (plan->videos.empty() && plan->unopened.empty()) return check_impossible(*plan, options.recipe);
  if (!options.merge) warn_of_unseen(videos, visibilities);
  std::fputs(resamples_line(videos).c_str(), stderr);
  request.folder = options.folder.empty() ? std::filesystem::path(plan->name) : options.folder;
  defer_interrupts();
  tune_allocator();
  ConsoleReporter reporter(options.progress);
  const Result<DatasetReport> report = make_dataset(*plan, request, reporter.control());
  reporter.end();
  if (!report) return fail(report.error());
  const Result<void> made = print_report(*report);
  // The run that makes the index reports errors of the whole recipe; a shard those of its videos.
  const Result<void> possible = request.shard ? Result<void>() : check_impossible(*plan, options.recipe);
  return made ? possible : made;
}

}  // namespace

Command add_dataset_command(CLI::App& program) {
  const auto options = std::make_shared<DatasetOptions>();
  CLI::App* const command =
      program.add_subcommand("dataset", "make a whole dataset from a recipe: videos, truth, labels, index");
  command->add_option("RECIPE", options->recipe, "the recipe, a JSON file; or the folder of a dataset that was made")
      ->required();
  add_output(*command, "--out", options->folder, "folder to write into; not given: the dataset's name", "DIR");
  command
      ->add_option(
          "--jobs", options->jobs,
          "videos exported side by side; 0: one for every four processor cores, of one clip mostly up to eight, "
          "which share its decoder, of single images one for each core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_flag("--resume", options->resume, "keep the videos that are complete and as the recipe asks");
  add_value(*command, "--shard", options->shard, "I/N", "only part I of N of the videos, and no index");
  add_value(*command, "--only", options->only, "NAMES", "only these videos, separated by commas, and no index")
      ->check(not_empty());
  command->add_flag("--merge", options->merge, "export nothing: make the index of videos that are there");
  command->add_flag("--dry-run", options->dry_run, "list what would be made, and write nothing");
  command->add_flag("--coverage", options->coverage,
                    "make nothing: count in the annotations of the dataset in --out what it covers");
  add_input(
      *command, "--domain", options->domain,
      "make nothing: state what of a design domain (a JSON file, or LARD's YAML) is covered; by a recipe as planned, "
      "with --coverage or a folder as made");
  add_output(*command, "--fill", options->files.fill,
             "with --domain: write the recipe with further videos for the bins that are empty");
  command->add_flag("--data-sheet", options->data_sheet,
                    "make nothing: describe the dataset in --out in its files DATASHEET.md and datasheet.json");
  add_output(*command, "--json", options->files.json,
             "write what --dry-run, --coverage or --domain prints of it as JSON");
  add_output(*command, "--plot", options->files.plot, "draw the same as histograms; a PNG");
  command->add_flag("--force", options->files.force, "replace the files of --json, --plot, --fill and --data-sheet");
  command->footer(kDatasetFooter);
  add_set_option(*command, options->project);
  add_progress_option(*command, options->progress);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
