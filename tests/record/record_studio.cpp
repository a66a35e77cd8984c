// SPDX-License-Identifier: MIT
// Performs the studio's motions once for all tests: record_studio FILE.
#include <cstdio>

#include "tests/support/studio_motions.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "record_studio needs one file to write.\n");
    return 2;
  }
  const ego::Result<void> written = ego::test::RecordStudio(argv[1]);
  if (!written) std::fprintf(stderr, "%s\n", written.error().c_str());
  return written ? 0 : 1;
}
