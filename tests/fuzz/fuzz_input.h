// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs::fuzz {

// What a target is given: the bytes of a file, and a folder in which it may write files for readers that take a path.
struct FuzzInput {
  std::string_view bytes;
  std::filesystem::path folder;  // exists; files of the input before may still lie in it

  // Writes the bytes, or others, to a file of this name in the folder, in place of an older one; returns its path.
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return file(name, bytes); }
  [[nodiscard]] std::filesystem::path file(const std::string& name, std::string_view content) const;
};

// Aborts unless an error or warning is as people are to see it: it says something, on one line that is not endless.
void check_message(const Error& error);
void check_messages(const std::vector<Warning>& warnings);

// --- The targets. Each gives the input to all readers of one family, as if it were a file of each of them. A reader
// may refuse it; what it accepts has to keep the promises of its header, else the program aborts.

void try_project(const FuzzInput& input);
void try_calibration(const FuzzInput& input);
void try_model(const FuzzInput& input);  // OBJ; behind a line "#MTL" the library of materials
void try_image(const FuzzInput& input);  // masks, textures, images of a sequence and their times
void try_text_log(const FuzzInput& input);
void try_binary_log(const FuzzInput& input);
void try_results(const FuzzInput& input);
void try_truth(const FuzzInput& input);
void try_recipe(const FuzzInput& input);
void try_recorded_path(const FuzzInput& input);
void try_encounter(const FuzzInput& input);
void try_encounter_model(const FuzzInput& input);
void try_sensor_model(const FuzzInput& input);  // tables of rules and shards of risk too
void try_video(const FuzzInput& input);

}  // namespace sigs::fuzz
