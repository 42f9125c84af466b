#include "mpm/export.h"

namespace conebench::mpm {
namespace {

using problems::Geometry;

void describe_nodes(const StepView& view, Geometry& geometry) {
  const Nodes& nodes = *view.nodes;
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Eigen::Vector3d x = nodes.mesh.grid().position(nodes.index[slot]);
    geometry.points.row(i) << x[0], x[1], x[2];
    for (int k = 0; k < 3; ++k) geometry.frames.row(i).segment(3 * k, 3) = axes.col(k);
    geometry.volume_fraction[i] = nodes.fraction(i);
    geometry.state[slot] = static_cast<int>((*view.states)[slot]);
  }
}

void describe_interfaces(const StepView& view, Geometry& geometry) {
  Eigen::Index row = view.nodes->count();
  for (const Interface& contact : view.assembly->interfaces) {
    geometry.points.row(row) = contact.point;
    for (int k = 0; k < 3; ++k) geometry.frames.row(row).segment(3 * k, 3) = contact.frame.col(k);
    geometry.bodies_of_cone(row, 0) = contact.body;
    ++row;
  }
}

Geometry geometry_of(const StepView& view) {
  const Eigen::Index cones = view.problem->cone_count();
  Geometry geometry;
  geometry.points.resize(cones, 3);
  geometry.frames.resize(cones, 9);
  geometry.volume_fraction.setZero(cones);
  geometry.state.assign(static_cast<std::size_t>(cones), -1);
  const auto bodies = static_cast<Eigen::Index>(view.bodies_before->size());
  if (bodies > 0) {
    geometry.bodies_of_cone.setConstant(cones, 2, -1);
    geometry.body_positions.resize(bodies, 3);
    geometry.body_radii.setZero(bodies);
    for (Eigen::Index b = 0; b < bodies; ++b) {
      const RigidBody& body = (*view.bodies_before)[static_cast<std::size_t>(b)];
      geometry.body_positions.row(b) = body.centre_m;
      if (body.body.shape == Shape::kBall) geometry.body_radii[b] = body.body.radius_m;
    }
  } else if (!view.assembly->interfaces.empty()) {
    geometry.bodies_of_cone.setConstant(cones, 2, -1);
  }
  describe_nodes(view, geometry);
  describe_interfaces(view, geometry);
  return geometry;
}

}  // namespace

problems::Problem make_problem(const Scene& scene, std::int64_t step, double h,
                               Assembly& assembly) {
  problems::Metadata metadata = engine::step_metadata(scene, "mpm", step, h);
  metadata.force_unit = "Pa s";
  metadata.rate_unit = "m3/s";
  return problems::Problem(std::move(assembly.data), assembly.cones, std::move(metadata));
}

problems::Problem with_states(const problems::Problem& base, const CohesionLaw& law,
                              const LawInput& input, const std::vector<NodeState>& states) {
  std::vector<problems::Cone> cones(base.cones().begin(), base.cones().end());
  Eigen::VectorXd w = base.w();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const int node = static_cast<int>(i);
    const NodeLaw chosen = law.law_of(input, node, states[i]);
    cones[i].kappa = chosen.kappa;
    w[base.start(node)] = chosen.gap;
  }
  return base.with_laws(std::move(cones), std::move(w));
}

void Exporter::operator()(const StepView& view) {
  write_if_selected(view, [&view] { return geometry_of(view); });
}

}  // namespace conebench::mpm
