// SPDX-License-Identifier: MIT
#include "cli/commands.h"

namespace sigs::cli {

namespace {

constexpr const char* kEvaluateFooter =
    "Examples:\n"
    "  sigs evaluate track projects/crossing/crossing.json --tracker csrt,kcf --out report\n"
    "  sigs evaluate track out/crossing.xml --results mine.txt --format otb\n"
    "  sigs evaluate detect out/crossing.xml --results found.csv\n"
    "  sigs evaluate performance datasets/mine --results found --out report --sensor sensor.json\n"
    "  sigs evaluate rig out/ring.rig.json --results found --out report\n"
    "\n"
    "sigs evaluate track --help, detect --help, performance --help and rig --help have the options of each.";

}  // namespace

Command add_evaluate_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("evaluate", "measure trackers and detectors against the truth");
  command->require_subcommand(1);
  command->footer(kEvaluateFooter);
  const Command track = add_evaluate_track(*command);
  const Command detect = add_evaluate_detect(*command);
  const Command performance = add_evaluate_performance(*command);
  const Command rig = add_evaluate_rig(*command);
  return [command, track, detect, performance, rig] {
    if (command->got_subcommand("rig")) return rig();
    if (command->got_subcommand("performance")) return performance();
    return command->got_subcommand("track") ? track() : detect();
  };
}

}  // namespace sigs::cli
