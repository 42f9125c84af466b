#pragma once

#include <filesystem>
#include <string_view>

namespace conebench::results {

/// Makes the folder and its parents. Throws problems::OutputError.
void make_folder(const std::filesystem::path& folder);

/// problems::write_file_atomically for text; makes missing folders.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace conebench::results
