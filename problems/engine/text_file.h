#pragma once

#include <filesystem>
#include <string_view>

namespace conebench::engine {

/// Makes a folder and its parents. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Writes a text file in one go. Throws OutputError when any of it cannot be written.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace conebench::engine
