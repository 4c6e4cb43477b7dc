// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "project/fields.h"

namespace sigs {

using Json = nlohmann::ordered_json;

// Puts a JSON value into a field. Returns what is wrong ("expected a number, found \"fast\""), empty if nothing.
// Ranges are validate()'s business.
[[nodiscard]] std::string put_json(const Json& json, const Field& field);

// The field's value as JSON.
[[nodiscard]] Json json_of(const Field& field);

}  // namespace sigs
