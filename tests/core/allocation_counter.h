// SPDX-License-Identifier: MIT
#pragma once

namespace ego::test {

/// How often this program has asked for memory with `new`.
long AllocationCount();

}  // namespace ego::test
