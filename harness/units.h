#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace conebench::harness {

/// "60s", "4ms", "500us", "2min", "1.5h", "20ns": seconds. A bare number is seconds.
/// Throws problems::InputError naming `option` and the known units; the value must be > 0.
double parse_duration_s(std::string_view text, std::string_view option);

/// "2G", "512MiB", "1.5GB": bytes. K, M, G, T (and KiB, ...) are powers of 1024; kB, MB, GB, TB
/// powers of 1000. A bare number is bytes. Throws problems::InputError; the value must be > 0.
std::uint64_t parse_bytes(std::string_view text, std::string_view option);

/// "1.5 GiB", "420 MiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace conebench::harness
