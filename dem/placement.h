#pragma once

#include <string_view>

#include "dem/scene.h"
#include "dem/spheres.h"

namespace conebench::dem {

/// Two things overlap when they do so by more than this share of the (smaller) radius.
constexpr double kOverlapTolerance = 1e-6;

/// The spheres of a scene at time 0: bodies in the order of the file, then columns, stacks, beds.
/// The same seed gives the same spheres on every machine.
///
/// With Scene::resolve, overlapping spheres are moved apart, each by half the overlap along the
/// line of centres (all of it when the other is fixed, or a plane), sweep after sweep until no
/// overlap is left; volume is not conserved and momentum plays no part.
///
/// Errors: InputError naming the first overlapping pair, or saying that 10 000 sweeps did not
/// part them. `subject` is what errors call the scene.
Spheres place_spheres(const Scene& scene, std::string_view subject);

}  // namespace conebench::dem
