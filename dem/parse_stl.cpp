#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <utility>

#include "dem/mesh_parsers.h"
#include "dem/text_lines.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using problems::require;

// A binary file: a header, the number of triangles, and for each the normal, three corners
// (floats, lowest byte first) and two bytes more.
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFirstTriangle = kHeaderBytes + 4;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kNormalBytes = 12;

// Collects triangles; corners with the same coordinates become one vertex.
class Collector {
 public:
  void add_corner(const std::array<double, 3>& x) {
    const auto [place, is_new] = vertices_.emplace(x, static_cast<int>(mesh_.vertices_m.size()));
    if (is_new) mesh_.vertices_m.emplace_back(x.data());
    triangle_(corners_++) = place->second;
    if (corners_ < 3) return;
    mesh_.triangles.push_back(triangle_);
    corners_ = 0;
  }

  Mesh mesh() && { return std::move(mesh_); }

 private:
  Mesh mesh_;
  std::map<std::array<double, 3>, int> vertices_;
  Eigen::Vector3i triangle_ = Eigen::Vector3i::Zero();
  int corners_ = 0;
};

// Lowest byte first.
std::uint32_t integer_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes[offset + k]);
  }
  return value;
}

Mesh parse_binary(std::string_view bytes, const std::string& subject) {
  require(bytes.size() >= kFirstTriangle, subject, "holds ", bytes.size(),
          " bytes, expected text that begins with 'solid' or at least ", kFirstTriangle, " bytes");
  const std::uint64_t count = integer_at(bytes, kHeaderBytes);
  require(bytes.size() == kFirstTriangle + kTriangleBytes * count, subject, "byte ", kHeaderBytes,
          ": says ", count, " triangles, which take ", kFirstTriangle + kTriangleBytes * count,
          " bytes, but the file holds ", bytes.size());
  Collector collector;
  for (std::size_t at = kFirstTriangle; at < bytes.size(); at += kTriangleBytes) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      const std::size_t first = at + kNormalBytes * corner;
      std::array<double, 3> x{};
      for (std::size_t k = 0; k < 3; ++k) {
        x[k] = std::bit_cast<float>(integer_at(bytes, first + 4 * k));
        require(std::isfinite(x[k]), subject, "byte ", first + 4 * k, ": found ", x[k],
                ", expected a finite coordinate");
      }
      collector.add_corner(x);
    }
  }
  return std::move(collector).mesh();
}

bool same_word(std::string_view word, std::string_view lower_case) {
  return std::ranges::equal(word, lower_case,
                            [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

using Words = std::initializer_list<std::string_view>;

bool begins_with(const TextLines& lines, Words words) {
  return lines.words().size() >= words.size() &&
         std::equal(words.begin(), words.end(), lines.words().begin(),
                    [](auto wanted, auto found) { return same_word(found, wanted); });
}

[[noreturn]] void fail(const TextLines& lines, const std::string& wanted) {
  const std::string found =
      lines.words().empty() ? "the file ends"
                            : "found '" + std::string(lines.words().front().substr(0, 40)) + "'";
  lines.fail(found + ", expected " + wanted);
}

// Goes to the next line, which must begin with these words.
void expect_line(TextLines& lines, Words words) {
  std::string wanted;
  for (const std::string_view word : words) wanted.append(wanted.empty() ? "" : " ").append(word);
  if (!lines.next() || !begins_with(lines, words)) fail(lines, "'" + wanted + "'");
}

void read_triangle(TextLines& lines, Collector& collector) {
  expect_line(lines, {"outer", "loop"});
  for (int corner = 0; corner < 3; ++corner) {
    expect_line(lines, {"vertex"});
    collector.add_corner({lines.number(1, "x"), lines.number(2, "y"), lines.number(3, "z")});
  }
  expect_line(lines, {"endloop"});
  expect_line(lines, {"endfacet"});
}

// One solid or several, one after the other.
Mesh parse_text(std::string_view text, const std::string& subject) {
  Collector collector;
  TextLines lines(text, subject);
  expect_line(lines, {"solid"});
  bool inside = true;
  while (lines.next()) {
    if (inside && begins_with(lines, {"facet"})) {
      read_triangle(lines, collector);
    } else if (begins_with(lines, {inside ? "endsolid" : "solid"})) {
      inside = !inside;
    } else {
      fail(lines, inside ? "'facet' or 'endsolid'" : "'solid' or the end of the file");
    }
  }
  if (inside) fail(lines, "'facet' or 'endsolid'");
  return std::move(collector).mesh();
}

// Headers of binary files may begin with 'solid' as well.
bool is_text(std::string_view bytes) {
  if (!same_word(bytes.substr(0, 5), "solid")) return false;
  if (bytes.size() < kFirstTriangle) return true;
  return bytes.size() != kFirstTriangle + kTriangleBytes * integer_at(bytes, kHeaderBytes) &&
         bytes.substr(0, kFirstTriangle).find('\0') == bytes.npos;
}

}  // namespace

Mesh parse_stl(std::string_view bytes, const std::string& subject) {
  Mesh mesh = is_text(bytes) ? parse_text(bytes, subject) : parse_binary(bytes, subject);
  require(!mesh.triangles.empty(), subject, "has no triangles, expected at least one");
  return mesh;
}

}  // namespace conebench::dem
