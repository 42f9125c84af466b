#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "harness/engine.h"

namespace conebench::harness {

/// What is measured of a run of a scene, of either engine.
enum class Observable {
  kEnergyChange,  ///< kinetic and potential energy at the end less at the start [J]
  kEnergyDrift,   ///< problems::excess_work() of all steps: what loose solves put in [J]
  kPenetration,   ///< Snapshot::penetration [-]
  kFront,         ///< 99 % of the mass is within it from where the centre of mass began [m]
  kCentreHeight,  ///< of the centre of mass, against gravity [m]
  kCentreShift,   ///< horizontal distance of the centre of mass from where it began [m]
  kAngle,         ///< engine::flank_angle() [degrees]
  kStepTime,      ///< wall clock in the step solver, a step [s]
  kIterations,    ///< of the step solver, a step
  kUnconverged,   ///< share of the steps that missed the tolerance
};
inline constexpr std::size_t kObservables = 10;

struct ObservableKind {
  Observable what;
  std::string_view key;    ///< in files: "front_m"
  std::string_view words;  ///< for people: "front"
  std::string_view unit;   ///< "m"; "-" without one
  bool physical;           ///< what a tolerance must be enough for; else a cost
  Observable yardstick;    ///< whose spread over seeds a deviation of it is held against
};

/// All of them, each at the place of its number.
std::span<const ObservableKind, kObservables> observables();

/// One value an observable; NaN where a run has none.
using Observed = std::array<double, kObservables>;

/// Watches one engine from where it is now. Keep it as long as the engine runs.
class Watch {
 public:
  explicit Watch(Engine& engine);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// What the run has come to since. Precondition: a step was done.
  Observed observed() const;

 private:
  const Engine& engine_;
  Snapshot start_;
  Eigen::Vector3d up_;
  double drift_J_ = 0.0;
};

}  // namespace conebench::harness
