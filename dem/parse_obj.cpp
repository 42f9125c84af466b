#include <algorithm>
#include <array>
#include <charconv>

#include "dem/mesh_parsers.h"
#include "dem/text_lines.h"

namespace conebench::dem {
namespace {

// Statements without bearing on the triangles.
constexpr std::array<std::string_view, 10> kPassedOver = {"vt",     "vn",     "g", "o", "s",
                                                          "usemtl", "mtllib", "l", "p", "vp"};

std::string quoted(std::string_view word) { return "'" + std::string(word.substr(0, 40)) + "'"; }

bool parse(std::string_view word, int& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

// The vertex of a corner: `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or from the last one
// read backwards where negative. What stands behind the first slash must be numbers or nothing.
int vertex_of(std::string_view corner, int count, const TextLines& lines) {
  int number = 0;
  bool good = true;
  std::string_view rest = corner;
  for (int part = 0; good && part < 3 && !(part > 0 && rest.empty()); ++part) {
    const std::string_view word = rest.substr(0, rest.find('/'));
    int value = 0;
    good = parse(word, value) || (part == 1 && word.empty());
    if (part == 0) number = value;
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
  }
  if (!good || !rest.empty() || corner.ends_with('/')) {
    lines.fail("found " + quoted(corner) + ", expected a corner: v, v/vt, v//vn or v/vt/vn");
  }
  const int vertex = number > 0 ? number - 1 : count + number;
  if (number == 0 || vertex < 0 || vertex >= count) {
    lines.fail("vertex " + std::to_string(number) + " of " + std::to_string(count) +
               " read so far, expected 1 to " + std::to_string(count) + " or -" +
               std::to_string(count) + " to -1");
  }
  return vertex;
}

void add_polygon(const TextLines& lines, Mesh& mesh) {
  const auto& words = lines.words();
  if (words.size() < 4) {
    lines.fail("a face of " + std::to_string(words.size() - 1) + " corners, expected at least 3");
  }
  const int count = static_cast<int>(mesh.vertices_m.size());
  Eigen::Vector3i triangle(vertex_of(words[1], count, lines), 0, vertex_of(words[2], count, lines));
  for (std::size_t k = 3; k < words.size(); ++k) {
    triangle(1) = triangle(2);
    triangle(2) = vertex_of(words[k], count, lines);
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

Mesh parse_obj(std::string_view text, const std::string& subject) {
  Mesh mesh;
  TextLines lines(text, subject);
  while (lines.next()) {
    const std::string_view keyword = lines.words().front();
    if (keyword == "v") {
      mesh.vertices_m.emplace_back(lines.number(1, "x"), lines.number(2, "y"),
                                   lines.number(3, "z"));
    } else if (keyword == "f") {
      add_polygon(lines, mesh);
    } else if (std::ranges::find(kPassedOver, keyword) == kPassedOver.end()) {
      lines.fail("found " + quoted(keyword) + ", expected a statement about vertices or polygons");
    }
  }
  if (mesh.triangles.empty()) lines.fail("the file ends and has no faces, expected at least one");
  return mesh;
}

}  // namespace conebench::dem
