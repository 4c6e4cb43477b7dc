// SPDX-License-Identifier: MIT
#include "dataset/domain_fill.h"

#include <string>
#include <string_view>
#include <vector>

#include "project/fields.h"
#include "project/project.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> path_keys() {
  Project project;
  project.intruders.resize(1);
  std::vector<std::string> keys;
  for (const Field& field : fields_of(project))
    if (field.is_path) keys.push_back(field.key);
  return keys;
}

template <class Function>
void for_each_in(Json& object, const char* key, const Function& f) {
  if (object.is_object() && object.contains(key) && object[key].is_array())
    for (Json& item : object[key]) f(item);
}

class PathMover {
 public:
  PathMover(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)), keys_(path_keys()) {}

  void move_all(Json& recipe) const {
    for (const std::string& key : keys_)
      if (recipe.contains("settings")) move_at(recipe["settings"], Json::json_pointer() / key);
    for_each_in(recipe, "backgrounds", [&](Json& background) {
      move_at(background, Json::json_pointer("/project"));
      for (const std::string& key : keys_) move_at(background, pointer_of(key));
    });
    for_each_in(recipe, "aircraft", [&](Json& aircraft) {
      constexpr std::string_view kIntruder = "intruders[0].";
      for (const std::string& key : keys_)
        if (key.starts_with(kIntruder)) move_at(aircraft, pointer_of(key.substr(kIntruder.size())));
      for_each_in(aircraft, "liveries", [&](Json& livery) { move(livery); });
    });
    for_each_in(recipe, "videos", [&](Json& group) {
      move_flights(group);
      for_each_in(group, "others", [&](Json& other) { move_flights(other); });
    });
  }

 private:
  void move(Json& path) const {
    if (!path.is_string() || path.get<std::string>().empty()) return;
    const fs::path old = path.get<std::string>();
    if (old.is_absolute()) return;
    const fs::path absolute = (from_ / old).lexically_normal();
    const fs::path moved = absolute.lexically_relative(to_);
    path = moved.empty() ? absolute.string() : moved.generic_string();
  }
  void move_at(Json& object, const Json::json_pointer& place) const {
    if (object.is_object() && object.contains(place)) move(object.at(place));
  }
  void move_flights(Json& group) const {
    for_each_in(group, "flights", [&](Json& flight) {
      for (const char* const key : {"file", "own_file"}) move_at(flight, Json::json_pointer() / key);
    });
  }

  fs::path from_, to_;
  std::vector<std::string> keys_;
};

}  // namespace

void move_recipe_paths(Json& recipe, const fs::path& from, const fs::path& to) {
  const fs::path old_folder = fs::absolute(from).parent_path().lexically_normal();
  const fs::path folder = fs::absolute(to).parent_path().lexically_normal();
  if (old_folder != folder) PathMover(old_folder, folder).move_all(recipe);
}

}  // namespace sigs
