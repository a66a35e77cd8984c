// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace ego::test {

/// Path of a file in the folder of real takes and characters that may lie beside the project
/// (../shared/data). It is not part of the project: a test that uses it skips where it is absent.
std::filesystem::path SharedData(std::string_view relative);

}  // namespace ego::test

/// Declares `path` and skips the test when the file is absent.
#define EGO_SHARED_DATA_OR_SKIP(path, relative)                                      \
  const std::filesystem::path path = ::ego::test::SharedData(relative);              \
  if (!std::filesystem::exists(path)) {                                              \
    GTEST_SKIP() << "no real data beside the project: " << relative << " not found"; \
  }                                                                                  \
  static_assert(true)
