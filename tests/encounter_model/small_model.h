// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sigs::test {

// A model made by hand, as sections with their lines. Of v the upper layer of L was never counted; of the successor of
// \dot h, the lower layer with \dot h in its lowest bin.
using SmallModel = std::vector<std::pair<std::string, std::string>>;

inline SmallModel small_model() {
  return {{"labels_initial", "\"L\", \"v\", \"\\dot h\" \n"},
          {"G_initial", "0 1 0 \n0 0 1 \n0 0 0 \n"},
          {"r_initial", "2 2 3 \n"},
          {"N_initial", "3 1 10 30 0 0 1 2 3 4 5 6 \n"},
          {"labels_transition", "\"L\", \"v\", \"\\dot h(t)\", \"\\dot h(t+1)\" \n"},
          {"G_transition", "0 0 0 1 \n0 0 0 0 \n0 0 0 1 \n0 0 0 0 \n"},
          {"r_transition", "2 2 3 3 \n"},
          {"N_transition", "0 0 0 5 5 0 8 1 1 1 8 1 2 0 2 0 0 7 \n"},
          {"boundaries", "0 1000 3000 \n40 80 120 \n-600 -100 100 600 \n"},
          {"resample_rates", "0 0 0.25 \n"}};
}

inline std::string text_of(const SmallModel& model) {
  std::string text;
  for (const auto& [name, lines] : model) text.append("# ").append(name).append("\n").append(lines);
  return text;
}

// The model with other lines in a section.
inline std::string with_section(const std::string& name, const std::string& lines) {
  SmallModel model = small_model();
  for (auto& section : model)
    if (section.first == name) section.second = lines;
  return text_of(model);
}

// The seven published models in the folder of real data.
inline std::vector<std::string> published_models() {
  return {"balloon_v1.txt",
          "glider_v1.txt",
          "paramotor_v1.txt",
          "skydiving_v1.txt",
          "weatherballoon_v1.txt",
          "uncor_1200only_fwme_v1p2.txt",
          "uncor_1200only_fwse_v1p2.txt"};
}

}  // namespace sigs::test
