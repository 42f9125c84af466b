#include "results/output.h"

#include <span>
#include <system_error>

#include "problems/atomic_file.h"
#include "problems/error.h"

namespace conebench::results {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw problems::OutputError(folder.string(), error.message());
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  problems::write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace conebench::results
