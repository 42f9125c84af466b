#pragma once

#include <string>
#include <string_view>

#include "dem/solid.h"
#include "problems/engine/toml_reader.h"

namespace conebench::dem {

/// A body that a generator makes.
struct Seedling {
  Pose pose;            ///< of the ball's centre, or of the shape's own frame
  double radius_m = 0;  ///< of a ball
  int solid = -1;       ///< as Nursery::shape() gave it; -1: a ball
  std::string material;
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  bool fixed = false;
  std::string motion;  ///< empty: none
};

/// Where generators put their bodies. A generator is a plain struct of a scene's numbers with
///
///   X read_x(engine::TomlReader in)       reads [[xs]], checks what can be checked without bodies
///   std::string show(const X&)            prints it so that it reads back the same
///   void place(const X&, Nursery&)        adds its bodies, in an order that never changes
class Nursery {
 public:
  virtual ~Nursery() = default;

  virtual int dimension() const = 0;
  /// What errors call the scene.
  virtual std::string_view subject() const = 0;
  /// Numbers in [0, 1), the same on every machine for the scene's seed.
  virtual double random() = 0;
  /// The solid of a shape of the scene by its name, or of a new one.
  virtual int shape(const std::string& name) = 0;
  virtual int shape(const Shape& made) = 0;
  virtual const Solid& solid(int solid) const = 0;
  virtual void add(const Seedling& seedling) = 0;
};

}  // namespace conebench::dem
