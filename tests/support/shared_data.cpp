// SPDX-License-Identifier: MIT
#include "tests/support/shared_data.h"

#include <string>

namespace ego::test {

std::filesystem::path SharedData(std::string_view relative) {
  return std::filesystem::path(EGO_SOURCE_DIR) / ".." / "shared" / "data" / std::string(relative);
}

}  // namespace ego::test
