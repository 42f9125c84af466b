#include "problems/engine/vtk.h"

#include <fmt/format.h>

#include <iterator>

#include "problems/engine/text_file.h"

namespace conebench::engine {
namespace {

void append(std::string& text, const Eigen::Vector3d& x) {
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", x[0], x[1], x[2]);
}
void append(std::string& text, double x) { fmt::format_to(std::back_inserter(text), "{}\n", x); }
void append(std::string& text, int x) { fmt::format_to(std::back_inserter(text), "{}\n", x); }

}  // namespace

PolyData::PolyData(int points) : points_(points) {
  text_ = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
      points);
}

template <class Value>
void PolyData::array(std::string_view type, std::string_view name, const Value& value) {
  constexpr int kComponents = std::is_same_v<Value, Vectors> ? 3 : 1;
  text_ += fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
      name, kComponents);
  for (int i = 0; i < points_; ++i) append(text_, value(i));
  text_ += "</DataArray>\n";
}

void PolyData::points(const Vectors& value) {
  text_ += "<Points>\n";
  vectors("points", value);
  text_ += "</Points>\n<Verts>\n";
  integers("connectivity", [](int i) { return i; });
  integers("offsets", [](int i) { return i + 1; });
  text_ += "</Verts>\n<PointData>\n";
}

void PolyData::vectors(std::string_view name, const Vectors& value) {
  array("Float64", name, value);
}
void PolyData::scalars(std::string_view name, const Scalars& value) {
  array("Float64", name, value);
}
void PolyData::integers(std::string_view name, const Integers& value) {
  array("Int32", name, value);
}

std::string PolyData::finish() {
  text_ += "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
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
