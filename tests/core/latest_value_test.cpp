// SPDX-License-Identifier: MIT
#include "core/base/latest_value.h"

#include <array>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace ego {
namespace {

TEST(LatestValue, NothingIsThereBeforeTheFirstPublication) {
  LatestValue<int> slot(7);
  EXPECT_FALSE(slot.Fetch());
  EXPECT_EQ(slot.Front(), 7);
  slot.Back() = 8;
  EXPECT_FALSE(slot.Fetch());
}

TEST(LatestValue, TheNewestWinsAndIsGivenOnce) {
  LatestValue<int> slot;
  for (int i = 1; i <= 5; ++i) {
    slot.Back() = i;
    slot.Publish();
  }
  ASSERT_TRUE(slot.Fetch());
  EXPECT_EQ(slot.Front(), 5);
  EXPECT_FALSE(slot.Fetch());
  EXPECT_EQ(slot.Front(), 5);
}

TEST(LatestValue, WritingNeverTouchesWhatTheReaderHolds) {
  LatestValue<int> slot;
  slot.Back() = 1;
  slot.Publish();
  ASSERT_TRUE(slot.Fetch());
  const int* held = &slot.Front();
  for (int i = 2; i < 20; ++i) {
    EXPECT_NE(&slot.Back(), held);
    slot.Back() = i;
    slot.Publish();
    EXPECT_EQ(*held, 1);
  }
}

// A torn or stale value would break the equality of the fields or the order of the counter.
TEST(LatestValue, TwoThreadsSeeWholeValuesInOrderAndTheLastOne) {
  struct Wide {
    std::array<std::uint64_t, 64> field{};
  };
  LatestValue<Wide> slot;
  constexpr std::uint64_t kLast = 200000;
  std::jthread writer([&slot] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      slot.Back().field.fill(i);
      slot.Publish();
    }
  });
  std::uint64_t seen = 0;
  while (seen < kLast) {
    if (!slot.Fetch()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& value = slot.Front();
    ASSERT_GT(value.field[0], seen);
    for (const std::uint64_t field : value.field) ASSERT_EQ(field, value.field[0]);
    seen = value.field[0];
  }
  EXPECT_EQ(seen, kLast);
}

}  // namespace
}  // namespace ego
