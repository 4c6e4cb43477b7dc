// SPDX-License-Identifier: MIT
#include "dataset/json_text.h"

namespace sigs {

Json described(const PlannedVideo& video) {
  Json json;
  json["name"] = video.name;
  json["split"] = video.split;
  json["tags"] = Json::object();
  for (const auto& [key, value] : video.tags) json["tags"][key] = value;
  json["drawn"] = Json::object();
  for (const auto& [key, value] : video.sampled) json["drawn"][key] = value;
  for (const auto& [condition, count] : video.resamples) json["redraws"][condition] = count;
  return json;
}

Json described(const std::vector<DatasetFile>& files, const std::string& before) {
  Json list = Json::array();
  for (const DatasetFile& file : files)
    list.push_back({{"path", before + file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return list;
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sigs
