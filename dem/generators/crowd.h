#pragma once

#include <string_view>

#include "dem/generators/generator.h"

namespace conebench::dem {

/// The most bodies that one generator makes.
constexpr double kLargestCrowd = 1e8;

/// Throws InputError unless a generator would make no more than kLargestCrowd bodies. Ask before
/// counts become integers. `key`: of the scene, for the error.
void check_crowd(double bodies, std::string_view key, const Nursery& nursery);

}  // namespace conebench::dem
