// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "assets/people/person.h"
#include "core/base/result.h"

namespace ego {

/// Reads the measurements of one or more people from JSON; the format is described in
/// assets/people/README.md. What is returned can be made (Validate). Errors name the file, the
/// person and the measurement.
Result<std::vector<PersonParameters>> ReadPeople(const std::filesystem::path& path);
/// The same from memory; `name` stands for the file in errors.
Result<std::vector<PersonParameters>> ParsePeople(std::string_view json, std::string_view name);

/// The JSON that reads back as these people: every measurement written out.
std::string FormatPeople(const std::vector<PersonParameters>& people);

}  // namespace ego
