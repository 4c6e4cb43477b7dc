// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <sstream>
#include <utility>

namespace sigs::cli {

namespace {

constexpr const char* kProgramFooter =
    "Examples:\n"
    "  sigs init flight.mp4\n"
    "  sigs init flight.mp4 --calibration gopro.xml --model cessna.obj\n"
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
    "  sigs calibrate board.mp4 --board chessboard --corners 9x6 --square-m 0.025 --out camera.xml\n"
    "  sigs appearance flight.mp4 --out settings.json --plot appearance.png\n"
    "  sigs path flight.gpx --out flight.kml\n"
    "  sigs encounter-model glider_v1.txt --samples 100 --out tracks.csv\n"
    "  sigs compare real.mp4 --boxes real_gt.csv --project mine.json --out beside.png\n"
    "  sigs encounter projects/head-on/head-on.json --plot encounter.png\n"
    "\n"
    "Exit status: 0 done, 64 usage, 65 bad data, 66 cannot read an input, 69 no OpenGL, encoder or memory,\n"
    "73 cannot create output, 74 write failed, 78 bad project, 130 interrupted,\n"
    "129 stopped by SIGHUP, 143 by SIGTERM.";

// The program's text below the options of one command that has none of its own: of the examples only its own.
std::string footer_of(const std::string& command) {
  std::istringstream lines{std::string(kProgramFooter)};
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("  sigs ") || line.starts_with("  sigs " + command + " ")) text += line + "\n";
  if (const std::size_t none = text.find("Examples:\n\n"); none != std::string::npos) text.erase(none, 11);
  text.pop_back();
  return text;
}

// With what it does, the last command that was added.
AddedCommand added(CLI::App& program, Command (*add)(CLI::App&)) {
  Command run = add(program);
  return {program.get_subcommands({}).back(), std::move(run)};
}

}  // namespace

Command add_below(CLI::App& command, std::initializer_list<Command (*)(CLI::App&)> below) {
  command.require_subcommand(1);
  std::vector<AddedCommand> commands;
  for (const auto add : below) commands.push_back(added(command, add));
  return [commands]() -> Result<void> {
    for (const AddedCommand& one : commands)
      if (one.app->parsed()) return one.run();
    return {};
  };
}

Program make_program() {
  Program program{std::make_unique<CLI::App>(
                      "Puts simulated aircraft into real UAV footage, and writes the truth beside it.", "sigs"),
                  {}};
  program.app->set_version_flag("--version", std::string("sigs ") + SIGS_VERSION);
  program.app->require_subcommand(1);
  program.app->footer(kProgramFooter);
  for (const auto add : {add_init_command,
                         add_export_command,
                         add_frame_command,
                         add_mask_command,
                         add_occluder_command,
                         add_dataset_command,
                         add_evaluate_command,
                         add_check_command,
                         add_info_command,
                         add_telemetry_command,
                         add_ego_motion_command,
                         add_appearance_command,
                         add_path_command,
                         add_calibrate_command,
                         add_compare_command,
                         add_encounter_command,
                         add_encounter_model_command,
                         add_risk_command,
                         add_model_command,
                         add_rig_command}) {
    program.commands.push_back(added(*program.app, add));
    CLI::App* const command = program.commands.back().app;
    if (command->get_footer() == kProgramFooter) command->footer(footer_of(command->get_name()));
  }
  return program;
}

std::string names_of(const std::vector<CLI::App*>& commands) {
  std::string names;
  for (std::size_t i = 0; i < commands.size(); ++i)
    names += (i == 0 ? "" : i + 1 == commands.size() ? " and " : ", ") + commands[i]->get_name();
  return names;
}

}  // namespace sigs::cli
