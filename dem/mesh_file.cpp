#include "dem/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "dem/mesh_parsers.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  problems::require(in.is_open() && !std::filesystem::is_directory(file), file.string(),
                    "cannot be opened for reading");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  problems::require(!in.bad(), file.string(), "cannot be read");
  return bytes;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  const std::string subject = file.string();
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  problems::require(ending == ".obj" || ending == ".stl", subject,
                    "a mesh file's name should end in .obj or .stl");
  const std::string bytes = bytes_of(file);
  return ending == ".obj" ? parse_obj(bytes, subject) : parse_stl(bytes, subject);
}

}  // namespace conebench::dem
