#include "problems/engine/vtk.h"

#include <fmt/format.h>

#include <iterator>
#include <type_traits>

#include "problems/engine/text_file.h"

namespace conebench::engine {
namespace {

void append(std::string& text, const Eigen::Vector3d& x) {
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", x[0], x[1], x[2]);
}
void append(std::string& text, double x) { fmt::format_to(std::back_inserter(text), "{}\n", x); }
void append(std::string& text, int x) { fmt::format_to(std::back_inserter(text), "{}\n", x); }

}  // namespace

PolyData::PolyData(int points) : points_(points) {}

PolyData::PolyData(int points, std::span<const std::vector<int>> polygons)
    : points_(points), polygons_(polygons) {}

void PolyData::points(const Vectors& value) {
  text_ = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<Points>\n",
      points_, polygons_ ? 0 : points_, polygons_ ? polygons_->size() : 0);
  array("Float64", "points", points_, value);
  text_ += "</Points>\n";
  if (polygons_) {
    polygons_as_cells();
  } else {
    points_as_cells();
  }
}

void PolyData::points_as_cells() {
  text_ += "<Verts>\n";
  array("Int32", "connectivity", points_, [](int i) { return i; });
  array("Int32", "offsets", points_, [](int i) { return i + 1; });
  text_ += "</Verts>\n<PointData>\n";
}

void PolyData::polygons_as_cells() {
  std::vector<int> corners, ends;
  for (const std::vector<int>& polygon : *polygons_) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    ends.push_back(static_cast<int>(corners.size()));
  }
  const auto in = [](const std::vector<int>& values) {
    return [&values](int i) { return values[static_cast<std::size_t>(i)]; };
  };
  text_ += "<Polys>\n";
  array("Int32", "connectivity", static_cast<int>(corners.size()), in(corners));
  array("Int32", "offsets", static_cast<int>(ends.size()), in(ends));
  text_ += "</Polys>\n<CellData>\n";
}

template <class Value>
void PolyData::array(std::string_view type, std::string_view name, int count, const Value& value) {
  constexpr int kComponents =
      std::is_same_v<std::invoke_result_t<Value, int>, Eigen::Vector3d> ? 3 : 1;
  text_ += fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
      name, kComponents);
  for (int i = 0; i < count; ++i) append(text_, value(i));
  text_ += "</DataArray>\n";
}

void PolyData::vectors(std::string_view name, const Vectors& value) {
  array("Float64", name, cells(), value);
}
void PolyData::scalars(std::string_view name, const Scalars& value) {
  array("Float64", name, cells(), value);
}
void PolyData::integers(std::string_view name, const Integers& value) {
  array("Int32", name, cells(), value);
}

std::string PolyData::finish() {
  text_ +=
      fmt::format("</{}Data>\n</Piece>\n</PolyData>\n</VTKFile>\n", polygons_ ? "Cell" : "Point");
  return std::move(text_);
}

std::string vtk_file_name(std::string_view prefix, std::int64_t step) {
  return fmt::format("{}_{:06}.vtp", prefix, step);
}

void write_vtk_series(const std::filesystem::path& folder, std::string_view prefix,
                      std::span<const VtkStep> steps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [time_s, step] : steps) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time_s,
                        vtk_file_name(prefix, step));
  }
  write_text_file(folder / fmt::format("{}.pvd", prefix), text + "</Collection>\n</VTKFile>\n");
}

}  // namespace conebench::engine
