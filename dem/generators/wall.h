#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a wall of bricks along x in running bond, course by course from the base upwards.
/// Every other course begins and ends with a shorter brick, so that all courses are equally long
/// and the joints lie above the middle of the bricks below. Courses touch.
struct Wall {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< middle of its base
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of a brick, along x, y and z
  std::int64_t courses = 0;
  std::int64_t bricks = 0;  ///< whole ones of the lowest course
  double gap_m = 0.0;       ///< of the joints in a course, >= 0, less than a brick
  std::string material;
};

Wall read_wall(engine::TomlReader in);
std::string show(const Wall& wall);
void place(const Wall& wall, Nursery& nursery);

}  // namespace conebench::dem
