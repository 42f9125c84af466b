#pragma once

#include <string_view>
#include <vector>

#include "dem/bodies.h"
#include "dem/scene.h"
#include "dem/solid.h"

namespace conebench::dem {

/// Two things overlap when they do so by more than this share of the smaller one's size.
constexpr double kOverlapTolerance = 1e-6;

/// A body or plane that moves as it is told.
struct Driven {
  int body = 0;    ///< in Bodies, planes included
  int motion = 0;  ///< in Scene::motions
  Pose rest;       ///< where it is at displacement identity
};

/// A scene at time 0.
struct Placement {
  Bodies bodies;
  std::vector<Solid> solids;
  std::vector<Piece> pieces;   ///< of all solids
  std::vector<Plane> planes;   ///< of the scene and its containers, in the order of Bodies
  std::vector<Driven> driven;  ///< in the order of Bodies
};

/// The bodies of a scene at time 0: in the order of the file, then those of the generators, kind by
/// kind, then the planes. The same seed gives the same bodies on every machine.
///
/// With Scene::resolve, bodies that overlap are moved apart, each by half the overlap along the
/// normal (all of it when the other is not free), sweep after sweep until no overlap is left;
/// volume is not conserved and momentum plays no part.
///
/// Errors: InputError naming the first overlapping pair, or saying that 10 000 sweeps did not
/// part them, or naming a body that moves farther in the first step than it is thick. `subject` is
/// what errors call the scene.
Placement place_bodies(const Scene& scene, std::string_view subject);

/// The velocities of driven bodies from time_s on for a step, and their places at time_s.
void drive(const Scene& scene, const Placement& placement, double time_s, Bodies& bodies);

}  // namespace conebench::dem
