#pragma once

#include <string>
#include <string_view>

#include "dem/shape.h"

namespace conebench::dem {

/// The mesh that a file's bytes describe; see read_mesh(). `subject` is what errors name.
Mesh parse_obj(std::string_view text, const std::string& subject);
Mesh parse_stl(std::string_view bytes, const std::string& subject);

}  // namespace conebench::dem
