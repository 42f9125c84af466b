#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace conebench::engine {

/// Red, green, blue, 0 to 255.
using Colour = Eigen::Vector3d;

/// Viridis, which colour-blind readers can read, at t in [0, 1]; clamped.
Colour viridis(double t);

/// "#rrggbb".
std::string hex(const Colour& colour);

/// Text as it may stand between tags.
std::string escaped(std::string_view text);

}  // namespace conebench::engine
