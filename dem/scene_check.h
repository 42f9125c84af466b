#pragma once

#include <string_view>

#include "dem/scene.h"

namespace conebench::dem {

/// What can be said of a scene before its bodies are placed. Throws InputError where a name of a
/// material, shape or motion is not known (with a suggestion) or there twice, or where a scene of
/// two dimensions has something that leaves the plane y = 0. Laws are checked once it is known
/// which materials move (place_bodies).
void check_scene(const Scene& scene, std::string_view subject);

}  // namespace conebench::dem
