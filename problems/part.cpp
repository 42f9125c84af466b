#include "problems/part.h"

#include <algorithm>

#include "problems/error.h"
#include "problems/residual.h"

namespace conebench::problems {
namespace {

void check_cones(const Problem& whole, std::span<const int> cones) {
  int last = -1;
  for (const int cone : cones) {
    require(cone > last && cone < whole.cone_count(), whole.name(), "cone ", cone, " after cone ",
            last, ", expected increasing numbers from 0 to ", whole.cone_count() - 1);
    last = cone;
  }
}

std::vector<Cone> laws_of(const Problem& whole, std::span<const int> cones) {
  std::vector<Cone> laws;
  for (const int cone : cones) laws.push_back(whole.cones()[static_cast<std::size_t>(cone)]);
  return laws;
}

// position[chosen[k]] = k, and -1 elsewhere.
std::vector<int> positions(std::span<const int> chosen, int size) {
  std::vector<int> position(static_cast<std::size_t>(size), -1);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    position[static_cast<std::size_t>(chosen[k])] = static_cast<int>(k);
  }
  return position;
}

// The dofs of every component of M that one of the rows reaches.
std::vector<int> touched_dofs(const Problem& whole, std::span<const int> rows) {
  const std::span<const int> component_of = whole.inertia().component_of();
  std::vector<bool> touched(static_cast<std::size_t>(whole.inertia().component_count()), false);
  const auto component = [&](Eigen::Index dof) {
    return static_cast<std::size_t>(component_of[static_cast<std::size_t>(dof)]);
  };
  for (const int row : rows) {
    for (SparseMatrix::InnerIterator it(whole.H(), row); it; ++it) {
      touched[component(it.col())] = true;
    }
  }
  std::vector<int> dofs;
  for (int dof = 0; dof < whole.dofs(); ++dof) {
    if (touched[component(dof)]) dofs.push_back(dof);
  }
  return dofs;
}

// The bodies that the chosen cones join, in increasing order.
std::vector<int> joined_bodies(const Geometry::Pairs& pairs) {
  std::vector<int> bodies;
  for (const int body : pairs.reshaped()) {
    if (body >= 0) bodies.push_back(body);
  }
  std::ranges::sort(bodies);
  bodies.erase(std::ranges::unique(bodies).begin(), bodies.end());
  return bodies;
}

void keep_joined_bodies(Geometry& part, std::string_view subject) {
  const std::vector<int> bodies = joined_bodies(part.bodies_of_cone);
  const int count = static_cast<int>(std::max(part.body_positions.rows(), part.body_radii.size()));
  if (count == 0) return;
  require(bodies.empty() || bodies.back() < count, subject, "bodies_of_cone names body ",
          bodies.empty() ? -1 : bodies.back(), ", expected -1 to ", count - 1);
  const std::vector<int> position = positions(bodies, count);
  for (int& body : part.bodies_of_cone.reshaped()) {
    if (body >= 0) body = position[static_cast<std::size_t>(body)];
  }
  if (part.body_positions.size() > 0) {
    part.body_positions = Geometry::Table(part.body_positions(bodies, Eigen::all));
  }
  if (part.body_radii.size() > 0) part.body_radii = Eigen::VectorXd(part.body_radii(bodies));
}

Geometry part_of(const Geometry& whole, const std::vector<int>& cones, std::string_view subject) {
  Geometry part = whole;
  if (whole.points.size() > 0) part.points = whole.points(cones, Eigen::all);
  if (whole.frames.size() > 0) part.frames = whole.frames(cones, Eigen::all);
  if (whole.volume_fraction.size() > 0) part.volume_fraction = whole.volume_fraction(cones);
  if (!whole.state.empty()) {
    part.state.clear();
    for (const int cone : cones) part.state.push_back(whole.state[static_cast<std::size_t>(cone)]);
  }
  if (whole.bodies_of_cone.size() > 0) {
    part.bodies_of_cone = whole.bodies_of_cone(cones, Eigen::all);
    keep_joined_bodies(part, subject);
  }
  return part;
}

}  // namespace

std::vector<int> rows_of(const Problem& problem, std::span<const int> cones) {
  std::vector<int> rows;
  for (const int cone : cones) {
    for (int k = 0; k < problem.cones()[static_cast<std::size_t>(cone)].dim; ++k) {
      rows.push_back(problem.start(cone) + k);
    }
  }
  return rows;
}

Problem part_of(const Problem& whole, std::span<const int> cones, Metadata metadata) {
  check_cones(whole, cones);
  const std::vector<int> rows = rows_of(whole, cones);
  std::vector<Cone> laws = laws_of(whole, cones);
  if (!whole.is_primal()) {
    SparseMatrix W =
        extract(whole.W(), rows, positions(rows, whole.rows()), static_cast<int>(rows.size()));
    return {ReducedData{std::move(W), whole.q()(rows)}, std::move(laws), std::move(metadata),
            whole.rate_scale()};
  }
  const std::vector<int> dofs = touched_dofs(whole, rows);
  const std::vector<int> position = positions(dofs, whole.dofs());
  const int size = static_cast<int>(dofs.size());
  return {PrimalData{extract(whole.M(), dofs, position, size),
                     extract(whole.H(), rows, position, size), whole.f()(dofs), whole.w()(rows)},
          std::move(laws), std::move(metadata), whole.rate_scale()};
}

ProblemFile part_of(const ProblemFile& whole, std::span<const int> cones, Metadata metadata) {
  ProblemFile part{part_of(whole.problem, cones, std::move(metadata)), {}, {}, {}};
  const std::vector<int> kept(cones.begin(), cones.end());
  const std::vector<int> rows = rows_of(whole.problem, cones);
  if (whole.geometry) part.geometry = part_of(*whole.geometry, kept, whole.problem.name());
  if (whole.guess.size() > 0) part.guess = whole.guess(rows);
  if (whole.solution) {
    const Eigen::VectorXd r = whole.solution->r(rows);
    part.solution =
        Solution{.r = r, .u = {}, .v = {}, .eta = evaluate_eta(part.problem.shifted(), r)};
  }
  return part;
}

}  // namespace conebench::problems
