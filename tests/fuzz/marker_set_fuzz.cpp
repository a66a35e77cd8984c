// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "assets/markers/marker_set_file.h"
#include "tests/support/sentence_law.h"

// Whatever the bytes: a sentence that names the file, or a valid set that writes and reads back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const ego::Result<ego::MarkerSet> set = ego::ParseMarkerSet(text, "fuzz.json");
  if (!set) {
    ego::test::CheckSentence(set.error(), "fuzz.json: ");
    return 0;
  }
  if (!ego::Validate(*set)) std::abort();
  const ego::Result<ego::MarkerSet> again =
      ego::ParseMarkerSet(ego::FormatMarkerSet(*set), "again.json");
  if (!again || again->markers.size() != set->markers.size()) std::abort();
  return 0;
}
