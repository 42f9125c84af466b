#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::engine {

/// The text of a ParaView file (.vtp): XML poly data. Call points() first, then one function an
/// array, then finish(). Each asks for its values by index.
class PolyData {
 public:
  using Vectors = std::function<Eigen::Vector3d(int)>;
  using Scalars = std::function<double(int)>;
  using Integers = std::function<int(int)>;

  /// Points, each of them seen; arrays are of the points.
  explicit PolyData(int points);
  /// Polygons, by indices of points; arrays are of the polygons. Keeps a reference to them.
  PolyData(int points, std::span<const std::vector<int>> polygons);

  void points(const Vectors& value);
  void vectors(std::string_view name, const Vectors& value);
  void scalars(std::string_view name, const Scalars& value);
  void integers(std::string_view name, const Integers& value);
  std::string finish();

 private:
  template <class Value>
  void array(std::string_view type, std::string_view name, int count, const Value& value);
  void points_as_cells();
  void polygons_as_cells();

  int cells() const { return polygons_ ? static_cast<int>(polygons_->size()) : points_; }

  int points_;
  std::optional<std::span<const std::vector<int>>> polygons_;
  std::string text_;
};

/// A written step of a run.
struct VtkStep {
  double time_s;
  std::int64_t step;
};

/// "<prefix>_<step, 6 digits>.vtp".
std::string vtk_file_name(std::string_view prefix, std::int64_t step);

/// Writes FOLDER/<prefix>.pvd, the time series of the files of these steps. Throws OutputError.
void write_vtk_series(const std::filesystem::path& folder, std::string_view prefix,
                      std::span<const VtkStep> steps);

}  // namespace conebench::engine
