#include "problems/engine/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "problems/error.h"

namespace conebench::engine {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw problems::OutputError(folder.string(), error.message());
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (file) return;
  throw problems::OutputError(path.string(), errno ? std::strerror(errno) : "cannot be written");
}

}  // namespace conebench::engine
