// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "encounter_model/encounter_model.h"
#include "encounter_model/small_model.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// What reading says, one line; empty where it succeeds.
std::string said_of(const std::string& text) {
  const Result<EncounterModel> model = encounter_model_of(text, "m.txt");
  if (model) return {};
  CHECK(model.error().text().find('\n') == std::string::npos);
  CHECK(model.error().text().starts_with("m.txt: "));
  return model.error().text();
}

bool says(const std::string& text, const std::string& place, const std::string& words) {
  const std::string said = said_of(text);
  INFO(said);
  const bool is_said = said.find(place) != std::string::npos && said.find(words) != std::string::npos;
  CHECK(is_said);
  return is_said;
}

}  // namespace

TEST_CASE("a model of three variables is read as it was written") {
  const EncounterModel model = encounter_model_of(text_of(small_model()), "m.txt").value();
  REQUIRE(model.variables.size() == 3);
  CHECK(model.variables[2].label == "\\dot h");
  CHECK(model.variables[2].boundaries == std::vector<double>{-600, -100, 100, 600});
  CHECK(model.variables[2].zero_bin == 1);
  CHECK_FALSE(model.variables[0].zero_bin.has_value());
  CHECK(model.variables[2].resample_rate == 0.25);
  CHECK(model.initial.tables[1].parents == std::vector<int>{0});
  CHECK(model.initial.tables[1].counts == std::vector<double>{10, 30, 0, 0});
  CHECK(model.initial.tables[1].parameters() == 2);
  CHECK(model.initial.order == std::vector<int>{0, 1, 2});
  CHECK(model.next_of == std::vector<int>{2});
  CHECK(model.transition.tables[3].parents == std::vector<int>{0, 2});
  CHECK(model.transition.tables[2].counts.empty());
  CHECK(model.warnings.empty());
}

TEST_CASE("the seven published models have the variables, bins and limits that their publishers' program reads") {
  if (!has_real_data()) return say_skipped("no published encounter models");
  const auto folder = real_data() / "encounters" / "models";
  const auto truth = nlohmann::json::parse(std::ifstream(folder / "exact_initial_marginals.json"));
  for (const std::string& name : published_models()) {
    CAPTURE(name);
    const Result<EncounterModel> model = read_encounter_model(folder / name);
    REQUIRE_MESSAGE(model.has_value(), (model ? "" : model.error().text()));
    REQUIRE(model->variables.size() == truth[name]["labels"].size());
    std::size_t counts = 0;
    for (const CountTable& table : model->transition.tables) counts += table.counts.size();
    CHECK(counts == truth[name]["N_transition_count"].get<std::size_t>());
    for (std::size_t i = 0; i < model->variables.size(); ++i) {
      const ModelVariable& variable = model->variables[i];
      CHECK(variable.label == truth[name]["labels"][i].get<std::string>());
      CHECK(variable.bins == truth[name]["r"][i].get<int>());
      const std::string limits = truth[name]["boundaries"][i].get<std::string>();
      CHECK(variable.boundaries.empty() == (limits == "*"));
      CHECK(variable.resample_rate == std::stod(truth[name]["resample_rates"][i].get<std::string>()));
    }
  }
}

TEST_CASE("sections in another order, other white space and a byte order mark make no difference") {
  SmallModel turned = small_model();
  std::reverse(turned.begin(), turned.end());
  std::string text = "\xEF\xBB\xBF\n" + text_of(turned) + "\n\n";
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
  CHECK(said_of(text) == "");
  CHECK(said_of(with_section("N_initial", "3 1 10\n30 0 0 1 2\n3 4 5 6\n")) == "");
}

TEST_CASE("the bin of zero can be stated, and a section that is not known is warned of") {
  const std::string text = text_of(small_model());
  const EncounterModel stated = encounter_model_of(text + "# zero_bins\n*\n1\n*\n", "m.txt").value();
  CHECK(stated.variables[1].zero_bin == 0);
  CHECK_FALSE(stated.variables[2].zero_bin.has_value());
  CHECK(says(text + "# zero_bins\n*\n3\n*\n", "# zero_bins", "outside 1 to 2"));
  CHECK(encounter_model_of(text + "# colours\n7\n", "m.txt").value().warnings.size() == 1);
}

TEST_CASE("a section that is missing, empty or there twice is named") {
  const SmallModel whole = small_model();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    SmallModel less = whole;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    CHECK(says(text_of(less), "# " + whole[i].first, "missing"));
    CHECK(says(with_section(whole[i].first, ""), "# " + whole[i].first, ""));
    CHECK(says(text_of(whole) + "# " + whole[i].first + "\n1\n", "# " + whole[i].first, "twice"));
  }
}

TEST_CASE("a number too many or too few is named with line and section") {
  for (const auto& [name, lines] : small_model()) {
    if (name.starts_with("labels")) continue;
    CHECK(says(with_section(name, lines + "1\n"), "# " + name, "expected"));
    const std::size_t last = lines.find_last_of(" \n", lines.find_last_of("0123456789"));
    CHECK(says(with_section(name, lines.substr(0, last) + "\n"), "# " + name, "expected"));
  }
  CHECK(says(with_section("boundaries", "0 1000 3000\n40 80\n-600 -100 100 600\n"), "line 24, # boundaries",
             "3 limits of 2 bins"));
}

TEST_CASE("numbers that cannot be are refused with line and section") {
  for (const char* const number : {"-1", "nan", "inf", "-inf", "1e999", "1e16", "x", "0x10", "1,0", "--1"}) {
    CAPTURE(number);
    CHECK(says(with_section("N_initial", std::string("3 1 10 30 0 0 1 2 3 4 5 ") + number + "\n"), "# N_initial", ""));
    CHECK(says(with_section("resample_rates", std::string("0 0 ") + number + "\n"), "# resample_rates", ""));
    CHECK(says(with_section("r_initial", std::string("2 2 ") + number + "\n"), "# r_initial", ""));
  }
  CHECK(says(with_section("resample_rates", "0 0 1.5\n"), "# resample_rates", "outside 0 to 1"));
  CHECK(says(with_section("boundaries", "0 1000 3000\n40 nan 120\n-600 -100 100 600\n"), "line 24", "finite"));
}

TEST_CASE("bins of no number or of a huge one take no memory and are refused") {
  CHECK(says(with_section("r_initial", "0 2 3\n"), "# r_initial", "outside 1"));
  CHECK(says(with_section("r_initial", "2.5 2 3\n"), "# r_initial", "whole"));
  CHECK(says(with_section("r_initial", "1e300 2 3\n"), "# r_initial", "outside 1"));
  CHECK(says(with_section("r_initial", "2 2 10000\n"), "# boundaries", "10001 limits"));
  CHECK(says(with_section("r_transition", "2 2 3 10000\n"), "# r_transition", "3 in # r_initial"));
  SmallModel wide;  // 40 variables of 10000 bins, each a parent of all after it: 1e160 counts
  std::string labels;
  std::string edges;
  std::string bins;
  std::string limits;
  for (int i = 0; i < 40; ++i) {
    labels += (i ? ", a" : "a") + std::to_string(i);
    bins += "10000 ";
    limits += "*\n";
    for (int j = 0; j < 40; ++j) edges += j > i ? "1 " : "0 ";
  }
  wide = {{"labels_initial", labels + "\n"}, {"G_initial", edges + "\n"}, {"r_initial", bins + "\n"},
          {"N_initial", "1 2 3\n"},          {"boundaries", limits},      {"resample_rates", bins + "\n"}};
  for (auto& section : wide)
    if (section.first == "resample_rates") section.second = std::string(80, '0') + "\n";
  std::string rates;
  for (int i = 0; i < 40; ++i) rates += "0 ";
  wide.back().second = rates + "\n";
  CHECK(says(text_of(wide), "# N_initial", "found 3"));
}

TEST_CASE("a graph that is none, and labels that do not fit, are refused") {
  CHECK(says(with_section("G_initial", "0 1 0\n0 0 1\n1 0 0\n"), "# G_initial", "ancestor"));
  CHECK(says(with_section("G_initial", "1 0 0\n0 0 1\n0 0 0\n"), "# G_initial", "ancestor"));
  CHECK(says(with_section("G_initial", "0 0.5 0\n0 0 1\n0 0 0\n"), "# G_initial", "0 and 1"));
  CHECK(says(with_section("G_transition", "0 1 0 1\n0 0 0 0\n0 0 0 1\n0 0 0 0\n"), "# G_transition", "(t+1)"));
  CHECK(says(with_section("labels_initial", "\"L\", \"L\", \"v\"\n"), "# labels_initial", "twice"));
  CHECK(says(with_section("labels_initial", "\"L\", , \"v\"\n"), "# labels_initial", "empty"));
  CHECK(says(with_section("labels_transition", "L, v, \\dot h(t), v(t+1)\n"), "# labels_transition", "v(t+1)"));
  CHECK(says(with_section("labels_transition", "L, v, \\dot h, \\dot h(t+1)\n"), "# labels_transition", "(t+1)"));
  CHECK(says(with_section("labels_transition", "L, v, \\dot h(t)\n"), "# labels_transition", "missing"));
  CHECK(says(with_section("labels_transition", "L, v\n"), "# labels_transition", "at least the 3"));
  CHECK(says(with_section("boundaries", "0 1000 3000\n80 40 120\n-600 -100 100 600\n"), "line 24", "increase"));
  CHECK(says("\xff\xd8\xff\xe0 an image\n", "line 1", "not an encounter model"));
  CHECK(says("", "# labels_initial", "missing"));
}

TEST_CASE("a file cut off anywhere is read or refused in one line, and nothing else happens") {
  const std::string text = text_of(small_model());
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string cut = text.substr(0, size);  // a copy: reading behind its end is seen by sanitizers
    const bool is_refused = !said_of(cut).empty();
    // Only digits and white space of the last number can be missing without harm.
    if (size + 6 < text.size()) CHECK_MESSAGE(is_refused, size);
  }
  if (!has_real_data()) return say_skipped("no published encounter models");
  const std::string whole = read_text(real_data() / "encounters" / "models" / "paramotor_v1.txt").value();
  for (std::size_t heading = whole.find('#'); heading != std::string::npos; heading = whole.find('#', heading + 1))
    for (const std::size_t size : {heading, heading + 5, whole.find('\n', heading) + 1, whole.find('\n', heading) + 3})
      CHECK_FALSE(said_of(whole.substr(0, size)).empty());
}

}  // namespace sigs::test
