// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "appearance/target_look.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "comparison/inserted_target.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kCompareFooter =
    "Examples:\n"
    "  sigs compare real.mp4 --boxes real_gt.csv\n"
    "  sigs compare real.mp4 --box 312,204,36,24 --frame 100 --project a.json --project b.json \\\n"
    "    --calibration pinhole.yml --out beside.png --csv beside.csv";

constexpr int kEnlarged = 8;
constexpr int kMaxPiece_px = 1600;  // of an enlarged target; larger ones are enlarged less

struct CompareOptions {
  fs::path video;
  SequenceTiming timing;  // of images
  std::string box;        // X,Y,W,H; empty: --boxes
  fs::path boxes;
  std::optional<int> frame;
  std::vector<fs::path> projects;
  std::vector<std::string> settings;
  fs::path calibration;  // empty: the projects' own
  std::string at;        // X,Y; empty: a similar place
  bool shake = false;
  int seed = 1;
  fs::path image;  // empty: none
  fs::path csv;    // likewise
  bool force = false;
};

// One column of the table.
struct CompareColumn {
  std::string name;
  std::optional<MeasuredTarget> target;  // none: not to be told from the background
};

using Boxes = std::vector<std::optional<Box>>;

Result<Boxes> boxes_of(const CompareOptions& options) {
  if (options.box.empty() == options.boxes.empty())
    return fail(options.video.string(), "say where the aircraft is by either --box with --frame, or --boxes",
                ErrorKind::usage);
  if (!options.boxes.empty()) return read_target_boxes(options.boxes);
  if (!options.frame) return fail("--box", "is the aircraft in one frame; name it with --frame", ErrorKind::usage);
  const Result<Box> box = box_of_option("--box", options.box);
  if (!box) return fail(box.error());
  Boxes boxes(static_cast<std::size_t>(*options.frame) + 1);
  boxes.back() = *box;
  return boxes;
}

// The frame asked for, else the middle one of those with a box.
int frame_of(const CompareOptions& options, const Boxes& boxes) {
  if (options.frame) return *options.frame;
  std::vector<int> frames;
  for (std::size_t n = 0; n < boxes.size(); ++n)
    if (boxes[n]) frames.push_back(static_cast<int>(n));
  return frames[frames.size() / 2];
}

// The stretch around the frame, and the real target in it.
struct RealTarget {
  Stretch stretch;
  FootageShape shape;
  MeasuredTarget target;
};

Result<RealTarget> real_target(const CompareOptions& options) {
  const Result<Boxes> boxes = boxes_of(options);
  if (!boxes) return fail(boxes.error());
  Result<FrameSource> footage = FrameSource::open(options.video, nullptr, Quantisers::read, options.timing);
  if (!footage) return fail(footage.error());
  for (const Warning& warning : footage->info().warnings) print_warning(warning);
  const int frame = frame_of(options, *boxes), count = footage->info().frame_count();
  if (frame >= count)
    return fail(fmt::format("--frame {}", frame), fmt::format("the footage has frames 0 to {}", count - 1),
                ErrorKind::usage);
  Result<std::optional<Stretch>> stretch = stretch_around(*footage, *boxes, frame);
  if (!stretch) return fail(stretch.error());
  const std::string where = fmt::format("{}: frame {}", options.video.string(), frame);
  if (!*stretch) return fail(where, "has no box", ErrorKind::usage);
  auto target = measured_target((*stretch)->frames, (*stretch)->boxes);
  if (!target)
    return fail(where,
                "nothing in the box differs from its surroundings by enough; the box must hold all of the aircraft, "
                "and at least half of its surroundings must lie in the image",
                ErrorKind::bad_data);
  if (target->look.is_cut)
    print_warning({where, "what is in the box goes on beyond it; its measures are those of a part"});
  return RealTarget{*std::move(*stretch), shape_of(footage->info()), *std::move(target)};
}

Result<cv::Point2d> place_of(const CompareOptions& options, const RealTarget& real) {
  if (!options.at.empty()) {
    const auto numbers = numbers_of(options.at, 2);
    if (!numbers) return fail("--at " + options.at, "expected X,Y in pixels", ErrorKind::usage);
    return cv::Point2d((*numbers)[0], (*numbers)[1]);
  }
  const cv::Rect& box = real.target.look.box;
  const auto place =
      similar_place(real.stretch.middle_frame(), real.stretch.middle_box(),
                    {box.width + 8, std::max(box.height, box.width / 2) + 8}, static_cast<std::uint32_t>(options.seed));
  if (!place)
    return fail(options.video.string(), "has no other place of the aircraft's size; say where with --at",
                ErrorKind::bad_data);
  return *place;
}

Result<CompareColumn> inserted(const fs::path& file, const CompareOptions& options, const RealTarget& real,
                               cv::Point2d place_px, SceneFiles& files, ComposeContext& context) {
  Result<Project> project = project_of({.file = file, .settings = options.settings});
  if (!project) return fail(project.error());
  if (!options.calibration.empty()) project->footage.calibration = fs::absolute(options.calibration).string();
  Result<Insertion> insertion = Insertion::make(*project, real.stretch, real.shape, real.target, place_px,
                                                {.seed = static_cast<std::uint32_t>(options.seed)}, files, context);
  if (!insertion) return fail(insertion.error());
  auto target = insertion->target(*project, options.shake ? CameraShake::as_real_target : CameraShake::none);
  if (!target) return fail(target.error());
  if (!*target) print_warning({file.string(), "its intruder cannot be told from the background"});
  return CompareColumn{project->name, *std::move(target)};
}

std::optional<double> value_of(const CompareColumn& column, const LookMeasure& measure) {
  return column.target ? column.target->look.*measure.value : std::nullopt;
}

std::string compare_table_of(const std::vector<CompareColumn>& columns) {
  std::string table = fmt::format("{:<24}{:<7}", "measure", "unit");
  for (const CompareColumn& column : columns) table += fmt::format(" {:>12.12}", column.name);
  LookGroup group{};
  bool is_first = true;
  for (const LookMeasure& measure : look_measures()) {
    if (is_first || measure.group != group) table += fmt::format("\n{}", name_of(measure.group));
    group = measure.group;
    is_first = false;
    table += fmt::format("\n  {:<22}{:<7}", measure.name, measure.unit);
    for (const CompareColumn& column : columns) {
      const auto value = value_of(column, measure);
      table += fmt::format(" {:>12}", value ? fixed_text(*value, 3) : "-");
    }
  }
  return table + "\n";
}

std::string csv_of(const std::vector<CompareColumn>& columns) {
  std::string csv = "group,measure,unit,real";
  for (std::size_t i = 1; i < columns.size(); ++i) csv += "," + csv_field(columns[i].name);
  for (const LookMeasure& measure : look_measures()) {
    csv += fmt::format("\n{},{},{}", name_of(measure.group), measure.name, measure.unit);
    for (const CompareColumn& column : columns) csv += "," + exact_text(value_of(column, measure));
  }
  return csv + "\n";
}

// The targets side by side, enlarged alike.
cv::Mat image_of(const std::vector<CompareColumn>& columns) {
  cv::Size size;
  for (const CompareColumn& column : columns)
    if (column.target)
      size = {std::max(size.width, column.target->image.cols), std::max(size.height, column.target->image.rows)};
  const int factor = std::clamp(kMaxPiece_px / std::max(size.width, size.height), 1, kEnlarged);
  constexpr int kGap_px = 8, kName_px = 24;
  const int piece_px = size.width * factor + kGap_px;
  cv::Mat image(size.height * factor + kName_px, piece_px * static_cast<int>(columns.size()) - kGap_px, CV_8UC3,
                cv::Scalar::all(255));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const int left = static_cast<int>(i) * piece_px;
    cv::putText(image, columns[i].name, {left + 4, kName_px - 7}, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(0), 1,
                cv::LINE_AA);
    if (!columns[i].target) continue;
    cv::Mat large;
    cv::resize(columns[i].target->image, large, {}, factor, factor, cv::INTER_NEAREST);
    large.copyTo(image(cv::Rect({left, kName_px}, large.size())));
  }
  return image;
}

Result<void> check_names(const CompareOptions& options) {
  if (options.projects.empty() && !options.settings.empty())
    return fail("--set", "goes with a project", ErrorKind::usage);
  std::vector<fs::path> inputs{options.video, options.boxes, options.calibration};
  inputs.insert(inputs.end(), options.projects.begin(), options.projects.end());
  if (!options.image.empty())
    if (const Result<void> named = check_png_output("--out", options.image, {}); !named) return named;
  return check_outputs({{"--out", options.image}, {"--csv", options.csv}}, inputs);
}

Result<std::vector<CompareColumn>> compare_columns_of(const CompareOptions& options) {
  Result<RealTarget> real = real_target(options);
  if (!real) return fail(real.error());
  std::vector<CompareColumn> columns{{"real", real->target}};
  if (options.projects.empty()) return columns;
  const Result<cv::Point2d> place_px = place_of(options, *real);
  if (!place_px) return fail(place_px.error());
  SceneFiles files;
  ComposeContext context;
  for (const fs::path& file : options.projects) {
    Result<CompareColumn> column = inserted(file, options, *real, *place_px, files, context);
    if (!column) return fail(column.error());
    columns.push_back(*std::move(column));
  }
  return columns;
}

Result<void> run(const CompareOptions& options) {
  if (const Result<void> named = check_names(options); !named) return named;
  const Result<std::vector<CompareColumn>> columns = compare_columns_of(options);
  if (!columns) return fail(columns.error());
  defer_interrupts();
  OutputFiles files(options.force);
  const Result<void> written = files.write_and_commit({{options.image, [&] { return png_bytes(image_of(*columns)); }},
                                                       {options.csv, [&] { return csv_of(*columns); }}});
  if (!written) return written;
  std::fputs(compare_table_of(*columns).c_str(), stdout);
  print_written(files.final_paths());
  return {};
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("compare", "measure a real aircraft and ours beside it");
  const auto options = std::make_shared<CompareOptions>();
  add_subject(*command, "VIDEO", options->video, "footage with a real aircraft");
  add_timing_options(*command, options->timing);
  add_value(*command, "--box", options->box, "X,Y,W,H",
            "where the aircraft is: its first column and row, its width and height");
  add_input(*command, "--boxes", options->boxes, "the same for many frames: CSV with frame,label,x,y,w,h");
  add_value(*command, "--frame", options->frame, "N", "which frame, from 0; with --boxes the middle one where left out")
      ->check(CLI::Range(0, 10'000'000));
  add_input(*command, "--project", options->projects, "a project whose first intruder is put beside; may be repeated")
      ->allow_extra_args(false);
  add_value(*command, "--set", options->settings, "KEY=VALUE",
            "change a setting of the projects, KEY=VALUE; may be repeated")
      ->allow_extra_args(false);
  add_input(*command, "--calibration", options->calibration, "of the footage, in place of the projects'");
  add_value(*command, "--at", options->at, "X,Y",
            "where ours is put; a place with a similar background where left out");
  command->add_flag("--shake", options->shake, "ours moves with the camera's shake, taken from the real one's path");
  add_number(*command, "--seed", options->seed, "N", 0, 1'000'000, "chooses place and attitude");
  add_output(*command, "--out", options->image, "draw both side by side, 8 times enlarged; a PNG");
  add_output(*command, "--csv", options->csv, "write the table as CSV");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->footer(kCompareFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
