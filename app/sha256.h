// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4), for naming pictures by their content.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace candela {

// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::span<const std::byte> bytes);

}  // namespace candela
