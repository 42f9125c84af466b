#pragma once

#include <string>

#include "dem/scene.h"
#include "problems/engine/toml_reader.h"

namespace conebench::dem {

/// A shape is one piece ([[shapes]] with `kind`), or several ([[shapes.parts]]), each with a place.
/// Files are looked for beside the scene file, `subject`. Errors: InputError, also of the piece.
SceneShape read_shape(engine::TomlReader in, std::string_view subject);
std::string show(const SceneShape& shape);

/// The rigid displacement of a place and a rotation vector.
Pose pose_of(const Eigen::Vector3d& position_m, const Eigen::Vector3d& rotation_rad);

}  // namespace conebench::dem
