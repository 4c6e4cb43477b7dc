// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "dataset/recipe.h"
#include "dataset/sample.h"

namespace sigs {

// Declarations shared by the sources that read a recipe; recipe.h is the public interface.

// What is wrong with a recipe, collected while it is read: the first error, and every warning. Keys are written as
// "videos[0].name".
struct RecipeLog {
  std::string file;
  std::optional<Error> error;
  std::vector<Warning> warnings;

  void wrong(const std::string& key, const std::string& what, ErrorKind kind = ErrorKind::bad_data);
  void warn(const std::string& key, const std::string& what);
};

// One JSON object of a recipe, read key by key. A value of the wrong form is written to the log, and reading goes on
// with an empty one; the caller looks at the log in the end. JSON and log must outlive the node.
class RecipeNode {
 public:
  // key: of the object itself; empty for the whole recipe. JSON that is no object counts as an empty one, and is an
  // error in the log.
  RecipeNode(const Json& json, std::string key, RecipeLog& log);

  [[nodiscard]] std::string key_of(std::string_view name) const;  // "videos[0].name"
  [[nodiscard]] RecipeLog& log() const { return *log_; }

  // The value as it is; null where there is none. This call, and each of the following, marks its key as known.
  [[nodiscard]] const Json* value(std::string_view name);

  // Values of one form. None, or empty, where there is no such key or the value has another form.
  [[nodiscard]] std::optional<std::string> text(std::string_view name);
  [[nodiscard]] std::string needed_text(std::string_view name);  // error where it is missing or empty
  [[nodiscard]] std::optional<int> whole(std::string_view name, int low, int high);
  [[nodiscard]] std::vector<std::string> texts(std::string_view name);
  [[nodiscard]] std::map<std::string, std::string> text_map(std::string_view name);
  [[nodiscard]] std::vector<RecipeNode> nodes(std::string_view name);  // error where it is missing or empty

  // To be called when all known keys have been read: warns of the others. "about" is a remark and allowed everywhere.
  void done();

 private:
  const Json* json_;
  std::string key_;
  RecipeLog* log_;
  std::set<std::string, std::less<>> known_;
};

// A quantity as a recipe writes it: 5, {"uniform": [a, b]}, {"normal": {"mean": m, "deviation": d, "low": a,
// "high": b}} (bounds may be left out) or {"choice": [a, b, ...]}. Otherwise what is wrong with it.
[[nodiscard]] Possible<Quantity> quantity_of(const Json& json);

// The recipe's "videos"; backgrounds and aircraft must have been read. Mistakes are written to the node's
// log. settings: KEY=VALUE given beside the recipe, which override a group's values.
[[nodiscard]] std::vector<VideoGroup> read_groups(RecipeNode& recipe_node, const Recipe& recipe,
                                                  const std::vector<std::string>& settings);

// One of the recipe's "backgrounds". Mistakes are written to the node's log.
//   settings  the recipe's, as KEY=VALUE; `base` has them
//   beside    those of them that were given beside the recipe, which override all that the background says
[[nodiscard]] Background read_background(RecipeNode node, const Project& base, const std::vector<std::string>& settings,
                                         const std::vector<std::string>& beside);

// Reads the object `name` of a node ("camera") as a project file has it below `project_key` ("camera",
// "intruders[0].model") into the project, and checks it. Paths are relative to the folder of project.file and become
// absolute. Mistakes and unknown keys are written to the node's log under the recipe's key.
void read_section(RecipeNode& node, const std::string& name, const std::string& project_key, Project& project);

// Sets KEY=VALUE that add_settings() has checked, over the background's own values.
void apply_settings(const std::vector<std::string>& settings, Project& project);

// Makes the paths of a project, which are relative to the folder of its file, absolute.
void make_paths_absolute(Project& project);

// "licence" and "source", which the data sheet takes from the recipe's text (data_sheet.h).
void read_origin(RecipeNode& node);

// A list of flights, and what files they name (relative to the recipe's folder) say. A flight given as a text is its
// kind; anything else is taken as it is.
//   list  null, or no list of at least one flight: error in the log
//   key   of the list
[[nodiscard]] std::vector<FlightPlan> read_flights(const Json* list, const std::string& key, RecipeLog& log);

// A group's "appearance": { "haze.visibility_m": QUANTITY, ... } or "camera": numbers of the project below that
// section, within their limits, by their keys in the project. Those that `settings` (KEY=VALUE given beside the recipe)
// set are left out; left_out are no keys there.
[[nodiscard]] std::map<std::string, Quantity> read_numbers(RecipeNode& group, const std::string& section,
                                                           const std::vector<std::string>& settings,
                                                           const std::vector<std::string>& left_out = {});

// Numbers of a section of the project in a node, by their keys there ("intruders[0].contrail.strands" of the node's
// "strands"), within their limits, without those that `settings` set and those named in left_out.
[[nodiscard]] std::map<std::string, Quantity> numbers_in(RecipeNode& node, const std::string& section,
                                                         const std::vector<std::string>& settings,
                                                         const std::vector<std::string>& left_out);

// A group's "others": a list of OthersPlan; without the key none.
[[nodiscard]] std::vector<OthersPlan> read_others(RecipeNode& group, const Recipe& recipe);

// The aircraft that a group or its others select by the key "aircraft"; `standard` where there is no such key.
[[nodiscard]] std::vector<std::string> selected_names(RecipeNode& group, const char* key,
                                                      const std::vector<std::string>& there,
                                                      const std::vector<std::string>& standard);

// A path of the recipe, which is relative to its folder.
[[nodiscard]] std::filesystem::path from_recipe_folder(const RecipeNode& node, const std::string& name);

// A quantity; none where there is no such key or it has another form, which is written to the log.
[[nodiscard]] std::optional<Quantity> read_quantity(RecipeNode& node, std::string_view name);

// The same, with an error in the log where it can lie outside these limits; it is returned all the same.
[[nodiscard]] std::optional<Quantity> quantity_between(RecipeNode& node, std::string_view name, double low,
                                                       double high);

// Error in the log where a tag has a name that every video has as a tag of its own: background, aircraft, flight.
void check_tags(const std::map<std::string, std::string>& tags, RecipeNode& node);

}  // namespace sigs
