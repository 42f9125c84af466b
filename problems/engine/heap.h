#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace conebench::engine {

/// A grain that can move, or a particle of sand.
struct Grain {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its centre [m]
  double mass = 0.0;                                   ///< > 0 [kg]
  double radius = 0.0;                                 ///< of a ball (2D: disc) as large, > 0 [m]
};

/// What moves, at one moment: enough to measure it without knowing the engine.
struct Heap {
  std::vector<Grain> grains;
  double cell_m = 0.0;  ///< width of a column over which the surface has one height, > 0
};

/// Precondition here and below: there is a grain.
Eigen::Vector3d centre_of_mass(const Heap& heap);

/// The distance from the vertical through `from` within which `share` of the mass lies [m]. With
/// 0.99 the front of a collapse, which no single grain that rolls away moves. `up` has length 1.
double reach(const Heap& heap, const Eigen::Vector3d& up, const Eigen::Vector3d& from,
             double share);

/// The inclination of the flanks [rad]: least squares of the surface's height against the distance
/// to the nearest summit. The surface is the highest grain of every column of cell_m; summits are
/// the columns of at least 80 % of the heap's height, flanks those of 20 to 80 %; the height is
/// from the lowest grain. So ridges, cones, quarter cones and heaps against a wall are measured
/// alike. Nothing when fewer than three columns are flanks or all are as far from a summit: a
/// standing column, a layer.
/// Cost: columns of the flanks times those of the summits.
std::optional<double> flank_angle(const Heap& heap, const Eigen::Vector3d& up);

}  // namespace conebench::engine
