// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "base/threads.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/process.h"

namespace {

constexpr const char* kProgramFooter =
    "Examples:\n"
    "  sigs init flight.mp4\n"
    "  sigs export projects/crossing/crossing.json --out out\n"
    "  sigs export projects/head-on/head-on.json --out out --codec h264 --frames 0-99\n"
    "  sigs frame projects/crossing/crossing.json --frame 100 --stages --out out\n"
    "  sigs mask assets/footage/sample.mp4 --out out/own_body.png\n"
    "  sigs dataset projects/table1/table1.json --out table1 --resume\n"
    "  sigs evaluate track projects/crossing/crossing.json --tracker csrt,kcf --out out/report\n"
    "  sigs check projects/crossing/crossing.json\n"
    "  sigs info assets/footage/sample.mp4\n"
    "  sigs telemetry flight.mp4 --out flight.csv\n"
    "  sigs ego-motion flight.mp4 --calibration gopro.xml --out attitude.csv\n"
    "  sigs appearance flight.mp4 --out settings.json --plot appearance.png\n"
    "  sigs path flight.gpx --out flight.kml\n"
    "  sigs encounter-model glider_v1.txt --samples 100 --out tracks.csv\n"
    "  sigs compare real.mp4 --boxes real_gt.csv --project mine.json --out beside.png\n"
    "  sigs encounter projects/head-on/head-on.json --plot encounter.png\n"
    "\n"
    "Exit status: 0 done, 64 usage, 65 bad data, 66 cannot read an input, 69 no OpenGL, encoder or memory,\n"
    "73 cannot create output, 74 write failed, 78 bad project, 130 interrupted,\n"
    "129 stopped by SIGHUP, 143 by SIGTERM.";

struct AddedCommand {
  CLI::App* app;
  sigs::cli::Command run;
};

bool is_no_evaluation(std::string_view word) {
  return !word.starts_with('-') && word != "track" && word != "detect";
}

int run(int argc, char** argv) {
  using namespace sigs::cli;
  CLI::App program("Puts simulated aircraft into real UAV footage, and writes the truth beside it.", "sigs");
  program.set_version_flag("--version", std::string("sigs ") + SIGS_VERSION);
  program.require_subcommand(1);
  program.footer(kProgramFooter);
  std::vector<AddedCommand> commands;
  for (const auto add : {add_init_command, add_export_command, add_frame_command, add_mask_command,
                         add_occluder_command, add_dataset_command, add_evaluate_command, add_check_command,
                         add_info_command, add_telemetry_command, add_ego_motion_command, add_appearance_command,
                         add_path_command, add_compare_command, add_encounter_command, add_encounter_model_command}) {
    Command run = add(program);
    commands.push_back({program.get_subcommands({}).back(), std::move(run)});
  }
  const auto is_asked_for = [&](const AddedCommand& command) { return command.app->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && std::none_of(commands.begin(), commands.end(), is_asked_for)) {
    print_error(
        {argv[1],
         "no such command; there are init, export, frame, mask, occluder, dataset, evaluate, check, info, telemetry, "
         "ego-motion, appearance, path, compare, encounter and encounter-model",
         sigs::ErrorKind::usage});
    return static_cast<int>(sigs::ErrorKind::usage);
  }
  if (argc > 2 && argv[1] == std::string_view("evaluate") && is_no_evaluation(argv[2])) {
    print_error(
        {std::string("evaluate ") + argv[2], "no such command; there are track and detect", sigs::ErrorKind::usage});
    return static_cast<int>(sigs::ErrorKind::usage);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(sigs::ErrorKind::usage);
  }
  listen_for_interrupts();
  prepare_mesa();
  for (const AddedCommand& command : commands) {
    if (!command.app->parsed()) continue;
    if (const sigs::Result<void> done = command.run(); !done) {
      print_error(done.error());
      const sigs::ErrorKind kind = done.error().kind;
      return kind == sigs::ErrorKind::interrupted ? interrupted_status() : static_cast<int>(kind);
    }
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    print_error({"stdout", "could not be written", sigs::ErrorKind::write_failed});
    return static_cast<int>(sigs::ErrorKind::write_failed);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const sigs::Result<int> status = sigs::guarded([&]() -> sigs::Result<int> { return run(argc, argv); });
  if (status) return *status;
  sigs::cli::print_error(status.error());
  return static_cast<int>(status.error().kind);
}
