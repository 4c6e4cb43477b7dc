// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/json.h"
#include "project/fields.h"

namespace sigs {

// Sets a field to a JSON value. Returns what is wrong ("expected a number, found \"fast\""); empty where nothing is.
// Does not check ranges; validate() does.
[[nodiscard]] std::string put_json(const Json& json, const Field& field);

// The field's value as JSON.
[[nodiscard]] Json json_of(const Field& field);

}  // namespace sigs
