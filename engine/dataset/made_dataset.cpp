// SPDX-License-Identifier: MIT
#include "dataset/made_dataset.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "dataset/index.h"
#include "dataset/recipe.h"
#include "project/project.h"

namespace sigs {

Result<Json> read_index(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kIndexName;
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  return parsed_json(*text, file.string(), ErrorKind::bad_data);
}

Result<std::vector<IndexedVideo>> videos_in_index(const Json& index, const std::filesystem::path& file) {
  if (!index.is_object() || !index.contains("videos") || !index.at("videos").is_array())
    return fail(file.string(), "is no index of a dataset: it has no list \"videos\"");
  std::vector<IndexedVideo> videos;
  for (const Json& video : index.at("videos")) {
    const auto name = video.is_object() ? video.find("name") : video.end();
    if (!video.is_object() || name == video.end() || !name->is_string())
      return fail(file.string(), fmt::format("videos[{}] has no name", videos.size()));
    videos.push_back({.name = name->get<std::string>(), .split = {}, .tags = {}, .sampled = {}});
    IndexedVideo& read = videos.back();
    if (const std::string wrong = wrong_with_video_name(read.name); !wrong.empty())
      return fail(file.string(), fmt::format("videos[{}].name {}", videos.size() - 1, wrong));
    if (const auto split = video.find("split"); split != video.end() && split->is_string())
      read.split = split->get<std::string>();
    if (const auto tags = video.find("tags"); tags != video.end() && tags->is_object())
      for (const auto& [tag, value] : tags->items())
        if (value.is_string()) read.tags[tag] = value.get<std::string>();
    if (const auto drawn = video.find("drawn"); drawn != video.end() && drawn->is_object())
      for (const auto& [quantity, number] : drawn->items())
        if (number.is_number()) read.sampled[quantity] = number.get<double>();
  }
  return videos;
}

Result<pugi::xml_document> annotations_of(const std::filesystem::path& folder, const std::string& video) {
  const std::filesystem::path file = folder / video / (video + ".xml");
  const Result<std::string> text = read_text(file);
  if (!text)
    return fail(text.error().where, text.error().what + "; counting needs annotations: export.labels with xml",
                text.error().kind);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
  if (!parsed || !document.child("sigs")) return fail(file.string(), "is no SIGS annotation file");
  return document;
}

double attribute_of(pugi::xml_node node, const char* name) {
  const std::optional<double> number = parsed_number(trimmed(node.attribute(name).value()));
  return number.value_or(std::nan(""));
}

std::map<std::string, std::string> categories_of(const std::filesystem::path& folder, const std::string& video) {
  const std::filesystem::path project = folder / video / (video + ".json");
  std::map<std::string, std::string> categories;
  const Result<std::string> text = read_text(project);
  const Result<Json> json = text ? parsed_json(*text, project.string(), ErrorKind::bad_data) : fail(text.error());
  if (!json || !json->is_object() || !json->contains("intruders")) return categories;
  std::size_t id = 0;
  for (const Json& intruder : json->at("intruders")) {
    const auto category = intruder.is_object() ? intruder.find("category") : intruder.end();
    const bool is_given = intruder.is_object() && category != intruder.end() && category->is_string();
    categories[std::to_string(id++)] = is_given ? category->get<std::string>() : IntruderSettings{}.category;
  }
  return categories;
}

}  // namespace sigs
