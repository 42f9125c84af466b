// Problem::islands() and Problem::features(): structure, without solving anything.

#include <algorithm>
#include <map>

#include "problems/part.h"
#include "problems/problem.h"
#include "problems/union_find.h"

namespace conebench::problems {
namespace {

// Node ids: cones first, then components of M (primal); cones alone in the reduced form.
std::vector<int> island_of_node(const Problem& problem, int& count) {
  const int cones = problem.cone_count();
  const int components = problem.is_primal() ? problem.inertia().component_count() : 0;
  UnionFind sets(cones + components);
  const SparseMatrix& coupling = problem.is_primal() ? problem.H() : problem.W();
  std::vector<int> cone_of_row(static_cast<std::size_t>(problem.rows()));
  for (int i = 0; i < cones; ++i) {
    std::fill_n(cone_of_row.begin() + problem.start(i),
                problem.cones()[static_cast<std::size_t>(i)].dim, i);
  }
  for (int row = 0; row < problem.rows(); ++row) {
    const int cone = cone_of_row[static_cast<std::size_t>(row)];
    for (SparseMatrix::InnerIterator it(coupling, row); it; ++it) {
      const auto column = static_cast<std::size_t>(it.col());
      sets.join(cone, problem.is_primal() ? cones + problem.inertia().component_of()[column]
                                          : cone_of_row[column]);
    }
  }
  return sets.labels(count);
}

// Cones of each island.
std::vector<int> island_sizes(const Problem& problem) {
  int labels = 0;
  const std::vector<int> label = island_of_node(problem, labels);
  std::vector<int> sizes(static_cast<std::size_t>(labels), 0);
  for (int i = 0; i < problem.cone_count(); ++i) {
    ++sizes[static_cast<std::size_t>(label[static_cast<std::size_t>(i)])];
  }
  std::erase(sizes, 0);  // dofs without a cone
  return sizes;
}

template <class Get>
std::pair<double, double> range_of(std::span<const Cone> cones, Get get) {
  if (cones.empty()) return {0.0, 0.0};
  const auto [low, high] = std::minmax_element(
      cones.begin(), cones.end(), [&](const Cone& a, const Cone& b) { return get(a) < get(b); });
  return {get(*low), get(*high)};
}

}  // namespace

// `position` is scratch of size max(rows, dofs), all -1 before and after.
Island Problem::island(std::vector<int> cones, std::vector<int> dofs, int label,
                       std::vector<int>& position) const {
  const std::vector<int> rows = rows_of(*this, cones);
  const std::vector<int>& columns = is_primal() ? dofs : rows;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    position[static_cast<std::size_t>(columns[k])] = static_cast<int>(k);
  }
  const int size = static_cast<int>(columns.size());
  auto operators = std::make_shared<Operators>();
  operators->start = {0};
  std::vector<Cone> kept;
  for (const int i : cones) {
    kept.push_back(cones_[static_cast<std::size_t>(i)]);
    operators->start.push_back(operators->start.back() + kept.back().dim);
  }
  operators->mobility = mobility()(cones);
  if (is_primal()) {
    operators->M = extract(M(), dofs, position, size);
    operators->H = extract(H(), rows, position, size);
    operators->inertia =
        std::make_shared<const Inertia>(inertia().of_part(operators->M, dofs, position, name()));
  } else {
    operators->W = extract(W(), rows, position, size);
  }
  for (const int column : columns) position[static_cast<std::size_t>(column)] = -1;

  Metadata metadata = metadata_;
  metadata.name += "/island_" + std::to_string(label);
  Problem part(std::move(operators), std::move(kept), std::move(metadata), rate_scale_);
  if (is_primal()) {
    part.f_ = f_(dofs);
    part.w_ = w_(rows);
  }
  part.q_ = q_(rows);
  return {std::move(part), std::move(cones), std::move(dofs)};
}

std::vector<Island> Problem::islands() const {
  int labels = 0;
  const std::vector<int> label = island_of_node(*this, labels);
  std::vector<std::vector<int>> cones(static_cast<std::size_t>(labels)), dofs(cones.size());
  for (int i = 0; i < cone_count(); ++i) {
    cones[static_cast<std::size_t>(label[static_cast<std::size_t>(i)])].push_back(i);
  }
  for (int dof = 0; dof < this->dofs(); ++dof) {
    const int node = cone_count() + inertia().component_of()[static_cast<std::size_t>(dof)];
    dofs[static_cast<std::size_t>(label[static_cast<std::size_t>(node)])].push_back(dof);
  }
  std::vector<Island> result;
  std::vector<int> position(static_cast<std::size_t>(std::max(rows(), this->dofs())), -1);
  for (std::size_t k = 0; k < cones.size(); ++k) {
    if (cones[k].empty()) continue;
    result.push_back(
        island(std::move(cones[k]), std::move(dofs[k]), static_cast<int>(result.size()), position));
  }
  return result;
}

int Problem::island_count() const { return static_cast<int>(island_sizes(*this).size()); }

Features Problem::features() const {
  Features f;
  f.cones = cone_count();
  f.rows = rows();
  f.dofs = dofs();
  f.primal = is_primal();
  std::map<int, int> dims;
  for (const Cone& cone : cones_) ++dims[cone.dim];
  f.cones_of_dim.assign(dims.begin(), dims.end());
  f.mu = range_of(cones_, [](const Cone& c) { return c.mu; });
  f.kappa = range_of(cones_, [](const Cone& c) { return c.kappa; });
  f.theta = range_of(cones_, [](const Cone& c) { return c.theta; });
  if (mobility().size() > 0) f.mobility = {mobility().minCoeff(), mobility().maxCoeff()};
  f.coulomb =
      std::all_of(cones_.begin(), cones_.end(), [](const Cone& c) { return c.theta == c.mu; });
  const auto cohesive =
      std::count_if(cones_.begin(), cones_.end(), [](const Cone& c) { return c.kappa > 0.0; });
  if (f.cones > 0) f.cohesive_share = static_cast<double>(cohesive) / f.cones;
  if (is_primal()) {
    f.nonzeros_M = M().nonZeros();
    f.nonzeros_H = H().nonZeros();
    f.block_diagonal_mass = inertia().block_diagonal();
    if (f.dofs > 0) f.rows_per_dof = static_cast<double>(f.rows) / f.dofs;
  } else {
    f.nonzeros_W = W().nonZeros();
    f.asymmetry = asymmetry(W());
  }
  const std::vector<int> sizes = island_sizes(*this);
  f.islands = static_cast<int>(sizes.size());
  if (!sizes.empty()) f.largest_island = *std::max_element(sizes.begin(), sizes.end());
  f.rate_scale = rate_scale_;
  return f;
}

}  // namespace conebench::problems
