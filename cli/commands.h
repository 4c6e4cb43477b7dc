// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs::cli {

// What a subcommand does once the command line is read. The error is printed by main(), which takes the exit status
// from its kind.
using Command = std::function<Result<void>()>;

// Each adds one subcommand with its options to the program, and returns what it does. The command keeps what its
// options write to.
[[nodiscard]] Command add_appearance_command(CLI::App& program);       // sigs appearance
[[nodiscard]] Command add_calibrate_command(CLI::App& program);        // sigs calibrate
[[nodiscard]] Command add_check_command(CLI::App& program);            // sigs check
[[nodiscard]] Command add_compare_command(CLI::App& program);          // sigs compare
[[nodiscard]] Command add_dataset_command(CLI::App& program);          // sigs dataset
[[nodiscard]] Command add_ego_motion_command(CLI::App& program);       // sigs ego-motion
[[nodiscard]] Command add_encounter_command(CLI::App& program);        // sigs encounter
[[nodiscard]] Command add_encounter_model_command(CLI::App& program);  // sigs encounter-model
[[nodiscard]] Command add_evaluate_command(CLI::App& program);         // sigs evaluate, with its four subcommands
[[nodiscard]] Command add_export_command(CLI::App& program);           // sigs export
[[nodiscard]] Command add_frame_command(CLI::App& program);            // sigs frame
[[nodiscard]] Command add_info_command(CLI::App& program);             // sigs info
[[nodiscard]] Command add_init_command(CLI::App& program);             // sigs init
[[nodiscard]] Command add_mask_command(CLI::App& program);             // sigs mask
[[nodiscard]] Command add_model_command(CLI::App& program);            // sigs model, with its two subcommands
[[nodiscard]] Command add_occluder_command(CLI::App& program);         // sigs occluder
[[nodiscard]] Command add_path_command(CLI::App& program);             // sigs path
[[nodiscard]] Command add_rig_command(CLI::App& program);              // sigs rig, with its two subcommands
[[nodiscard]] Command add_risk_command(CLI::App& program);             // sigs risk
[[nodiscard]] Command add_telemetry_command(CLI::App& program);        // sigs telemetry

// Adds the subcommands of a command that has to be given one, and returns what that one does.
[[nodiscard]] Command add_below(CLI::App& command, std::initializer_list<Command (*)(CLI::App&)> below);

// The subcommands of sigs evaluate.
[[nodiscard]] Command add_evaluate_detect(CLI::App& evaluate);
[[nodiscard]] Command add_evaluate_performance(CLI::App& evaluate);
[[nodiscard]] Command add_evaluate_rig(CLI::App& evaluate);
[[nodiscard]] Command add_evaluate_track(CLI::App& evaluate);

// A subcommand of the program with what it does.
struct AddedCommand {
  CLI::App* app;
  Command run;
};

// The program `sigs`: its options, subcommands and help, nothing run yet. Its descriptions are also the man pages' and
// the completion's (cli/describe).
struct Program {
  std::unique_ptr<CLI::App> app;
  std::vector<AddedCommand> commands;  // in the order of the help
};

[[nodiscard]] Program make_program();

// The names of the subcommands, for messages: "export, frame and check".
[[nodiscard]] std::string names_of(const std::vector<CLI::App*>& commands);

}  // namespace sigs::cli
