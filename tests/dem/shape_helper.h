#pragma once

#include <random>
#include <vector>

#include "dem/shape.h"

namespace conebench::test {

/// Numbers between -1 and 1, standard normal ones, and what is made of them; the same ones for a
/// seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}

  double uniform() { return uniform_(generator_); }
  Eigen::Vector3d normal() {
    const double x = normal_(generator_), y = normal_(generator_), z = normal_(generator_);
    return {x, y, z};
  }
  Eigen::Vector3d direction() { return normal().normalized(); }
  Eigen::Quaterniond turn() {
    const Eigen::Vector3d axis = direction();
    return Eigen::Quaterniond(Eigen::AngleAxisd(3.1 * uniform(), axis));
  }
  dem::Pose pose() {
    const Eigen::Vector3d position = normal();
    return {position, turn()};
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
  std::normal_distribution<double> normal_;
};

/// One of each solid kind, none with two sizes alike but the ball.
std::vector<dem::Piece> one_of_each_solid();

std::vector<Eigen::Vector3d> moved(const std::vector<Eigen::Vector3d>& points,
                                   const dem::Pose& pose);

/// Points per side on a grid that fills the box between the corners -half and half.
std::vector<Eigen::Vector3d> grid(const Eigen::Vector3d& half, int per_side);

/// The surface of a box, as triangles turned outward.
dem::Mesh box_mesh(const Eigen::Vector3d& half);

/// A polyhedron cut into triangles, as a mesh.
dem::Mesh as_mesh(const dem::Polyhedron& polyhedron);

/// Whether every edge of the faces is met by one of another face that goes back.
bool is_closed(const std::vector<std::vector<int>>& faces);

}  // namespace conebench::test
