// SPDX-License-Identifier: MIT
#include "app/viewer/fields.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

// Each letter, and the ellipsis, is one wide.
float letters(const std::string& text) {
    return static_cast<float>(std::count_if(text.begin(), text.end(),
                                            [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

TEST(Fields, NamesAreShortenedBetweenLetters) {
    EXPECT_EQ(shortened("floor", 5, letters), "floor");
    EXPECT_EQ(shortened("floors", 5, letters), "floo\u2026");
    EXPECT_EQ(shortened("Tür\u00fcr\u00fc", 4, letters), "Tür\u2026");
    EXPECT_EQ(shortened("\u00fc\u00fc\u00fc", 2, letters), "\u00fc\u2026");
    EXPECT_EQ(shortened("ab", 1, letters), "\u2026");
    EXPECT_EQ(shortened("ab", 0.5f, letters), "");
    EXPECT_EQ(shortened("", 0, letters), "");
    // Half a letter would fit.
    const auto bytes = [](const std::string& text) { return static_cast<float>(text.size()); };
    EXPECT_EQ(shortened("\u00fc\u00fc\u00fc\u00fc", 6, bytes), "\u00fc\u2026");
}

}  // namespace
}  // namespace candela
