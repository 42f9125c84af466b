#include "harness/observables.h"

#include <limits>
#include <numbers>

#include "problems/engine/svg.h"
#include "problems/excess_work.h"

namespace conebench::harness {
namespace {

using enum Observable;

constexpr double kFrontShare = 0.99;

constexpr std::array<ObservableKind, kObservables> kKinds = {{
    {kEnergyChange, "energy_change_J", "energy change", "J", true, kEnergyChange},
    {kEnergyDrift, "energy_drift_J", "energy drift", "J", true, kEnergyChange},
    {kPenetration, "penetration", "penetration", "-", true, kPenetration},
    {kFront, "front_m", "front", "m", true, kFront},
    {kCentreHeight, "centre_height_m", "height of the centre", "m", true, kCentreHeight},
    {kCentreShift, "centre_shift_m", "shift of the centre", "m", true, kCentreShift},
    {kAngle, "angle_deg", "angle of repose", "degrees", true, kAngle},
    {kStepTime, "step_time_s", "solver time a step", "s", false, kStepTime},
    {kIterations, "iterations", "iterations a step", "-", false, kIterations},
    {kUnconverged, "unconverged_share", "steps not converged", "share", false, kUnconverged},
}};

double& at(Observed& values, Observable what) { return values[static_cast<std::size_t>(what)]; }

}  // namespace

std::span<const ObservableKind, kObservables> observables() { return kKinds; }

Watch::Watch(Engine& engine)
    : engine_(engine),
      start_(engine.snapshot()),
      up_(engine::level_axes(engine.scene().gravity_m_s2).row(1)) {
  engine.observe([this](const engine::SolvedStep& step) {
    if (step.problem != nullptr) drift_J_ += problems::excess_work(*step.standard, step.answer->r);
  });
}

Observed Watch::observed() const {
  const Snapshot now = engine_.snapshot();
  const auto steps = static_cast<double>(engine_.steps());
  Observed values;
  values.fill(std::numeric_limits<double>::quiet_NaN());
  at(values, kEnergyChange) = now.energy_J - start_.energy_J;
  at(values, kEnergyDrift) = drift_J_;
  at(values, kStepTime) = now.solve_s / steps;
  at(values, kIterations) = static_cast<double>(now.iterations) / steps;
  at(values, kUnconverged) = static_cast<double>(engine_.unconverged_steps()) / steps;
  if (now.heap.grains.empty()) return values;  // all of the sand has left
  const Eigen::Vector3d began = engine::centre_of_mass(start_.heap);
  const Eigen::Vector3d centre = engine::centre_of_mass(now.heap);
  const Eigen::Vector3d shift = centre - began;
  at(values, kPenetration) = now.penetration;
  at(values, kFront) = engine::reach(now.heap, up_, began, kFrontShare);
  at(values, kCentreHeight) = up_.dot(centre);
  at(values, kCentreShift) = (shift - up_.dot(shift) * up_).norm();
  if (const auto angle = engine::flank_angle(now.heap, up_)) {
    at(values, kAngle) = *angle * 180.0 / std::numbers::pi;
  }
  return values;
}

}  // namespace conebench::harness
