#pragma once

#include <string>

#include "dem/motion.h"
#include "problems/engine/toml_reader.h"

namespace conebench::dem {

/// [[motions]]: `kind` is slide, turn, shake or table. A table's file is looked for beside the
/// scene file, `subject`.
Motion read_motion(engine::TomlReader in, std::string_view subject);
std::string show(const Motion& motion);

}  // namespace conebench::dem
