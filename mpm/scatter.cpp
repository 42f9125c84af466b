#include <algorithm>

#include "mpm/nodes.h"
#include "mpm/refine.h"
#include "mpm/walls.h"

namespace conebench::mpm {
namespace {

// Sums the particles' solid volume at every node of the grid.
template <int D>
std::vector<double> solid_volumes(const Mesh& mesh, const Particles& particles) {
  std::vector<double> solid(static_cast<std::size_t>(mesh.grid().node_count()), 0.0);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = stencil_at<D>(mesh, particles.position[p]);
    for (std::size_t k = 0; k < Stencil<D>::kNodes; ++k) {
      solid[static_cast<std::size_t>(s.node[k])] += particles.volume[p] * s.weight[k];
    }
  }
  return solid;
}

void activate(const std::vector<double>& solid, Nodes& nodes) {
  nodes.index.clear();
  nodes.slot_of.assign(solid.size(), -1);
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const int node = static_cast<int>(i);
    if (solid[i] <= Nodes::kLeastShare * nodes.mesh.node_volume(node)) continue;
    nodes.slot_of[i] = nodes.count();
    nodes.index.push_back(node);
  }
  const int count = nodes.count();
  nodes.solid.resize(count);
  nodes.volume.resize(count);
  for (int i = 0; i < count; ++i) {
    const int node = nodes.index[static_cast<std::size_t>(i)];
    nodes.solid[i] = solid[static_cast<std::size_t>(node)];
    nodes.volume[i] = nodes.mesh.node_volume(node);
  }
  nodes.covered.setZero(count);
  nodes.cohesion.setZero(count);
  nodes.friction.setZero(count);
  const auto size = static_cast<std::size_t>(count);
  nodes.velocity.assign(size, Eigen::Vector3d::Zero());
  nodes.stress.assign(size, Particles::Stress::Zero());
  const int neighbours = neighbour_count(nodes.mesh.grid().dim, nodes.mesh.reach());
  nodes.coupling.assign(size * static_cast<std::size_t>(neighbours), Eigen::Vector3d::Zero());
}

// For each node of a stencil a number, such that node k is neighbour number middle + out[k] -
// out[i] of node i.
template <int D>
std::array<int, Stencil<D>::kNodes> neighbour_numbers(const Mesh& mesh, const Stencil<D>& s) {
  std::array<int, Stencil<D>::kNodes> out{};
  const int side = 2 * mesh.reach() + 1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto bits = static_cast<int>(k);
    const Eigen::Vector3i at = mesh.regular() ? Eigen::Vector3i(bits & 1, bits >> 1 & 1, bits >> 2)
                                              : mesh.grid().place(s.node[k]);
    out[k] = at[0] + side * (at[1] + side * at[2]);
  }
  return out;
}

// Sums over particles; `friction` holds the sum of inertial numbers meanwhile.
template <int D>
void sum(const Particles& particles, Nodes& nodes) {
  constexpr std::size_t kNodes = Stencil<D>::kNodes;
  const int neighbours = neighbour_count(D, nodes.mesh.reach());
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Stencil<D> s = active_stencil<D>(nodes, particles.position[p]);
    const auto number = neighbour_numbers<D>(nodes.mesh, s);
    const Vec<D> v = particles.velocity[p].template head<D>();
    const Eigen::Matrix<double, D, D> C = particles.affine[p].template topLeftCorner<D, D>();
    for (std::size_t i = 0; i < kNodes; ++i) {
      const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[i])];
      if (slot < 0) continue;
      const auto place = static_cast<std::size_t>(slot);
      const double share = particles.volume[p] * s.weight[i];
      nodes.velocity[place].template head<D>() += share * (v + C * s.reach[i]);
      nodes.stress[place] += share * particles.stress[p];
      nodes.cohesion[slot] += share * particles.cohesion[p];
      nodes.friction[slot] += share * particles.inertial_number[p];
      const auto itself = Eigen::Index{slot} * neighbours + neighbours / 2 - number[i];
      for (std::size_t k = 0; k < kNodes; ++k) {
        nodes.coupling[static_cast<std::size_t>(itself + number[k])].template head<D>() +=
            share * s.gradient[k];
      }
    }
  }
}

void divide(const Material& material, Nodes& nodes) {
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const double share = 1.0 / nodes.solid[i];
    nodes.velocity[slot] *= share;
    nodes.stress[slot] *= share;
    nodes.cohesion[i] *= share;
    const double I = nodes.friction[i] * share;
    nodes.friction[i] =
        material.friction + material.friction_rise * I / (I + material.inertial_number_0);
  }
}

template <int D>
void scatter_in(const Scene& scene, const Particles& particles, Nodes& nodes) {
  nodes.mesh = mesh_for(scene, particles);
  activate(solid_volumes<D>(nodes.mesh, particles), nodes);
  sum<D>(particles, nodes);
  divide(scene.material, nodes);
}

constexpr int kSamples = 4;  // of a cell, along each axis

// The integral of the node's shape function on a regular grid over what the bodies cover.
double covered_volume(const Grid& grid, int node, const std::vector<RigidBody>& bodies) {
  const Eigen::Vector3d x = grid.position(node);
  const Eigen::Vector3i at = grid.place(node);
  Eigen::Vector3i samples = Eigen::Vector3i::Ones();
  for (int a = 0; a < grid.dim; ++a) samples[a] = 2 * kSamples;
  double volume = 0.0;
  for (int k = 0; k < samples.prod(); ++k) {
    const Eigen::Vector3i place(k % samples[0], k / samples[0] % samples[1],
                                k / samples[0] / samples[1]);
    Eigen::Vector3d y = x;
    double weight = grid.cell_volume() / std::pow(kSamples, grid.dim);
    for (int a = 0; a < grid.dim; ++a) {
      const double offset = (place[a] + 0.5) / kSamples - 1.0;  // in cells, -1..1
      const bool outside = offset < 0.0 ? at[a] == 0 : at[a] == grid.cells[a];
      weight *= outside ? 0.0 : 1.0 - std::abs(offset);
      y[a] += offset * grid.spacing(a);
    }
    const bool inside = std::any_of(bodies.begin(), bodies.end(), [&](const RigidBody& body) {
      return distance_to(body, grid.dim, y).value < 0.0;
    });
    if (inside) volume += weight;
  }
  return volume;
}

// 1, or 1/2 for every closed barrier on which the node lies with sand on one side only.
double open_share(const Scene& scene, const Nodes& nodes, int node, double time_s) {
  double share = 1.0;
  for (const Barrier& barrier : scene.barriers) {
    if (!holds(scene, barrier, node, time_s)) continue;
    const auto sandy = [&](int step) {
      const int next = nodes.mesh.next(node, barrier.axis, step);
      return nodes.slot_of[static_cast<std::size_t>(next)] >= 0;
    };
    if (sandy(-1) != sandy(1)) share *= 0.5;
  }
  return share;
}

}  // namespace

void scatter(const Scene& scene, const Particles& particles, Nodes& nodes) {
  if (scene.grid.dim == 2) {
    scatter_in<2>(scene, particles, nodes);
  } else {
    scatter_in<3>(scene, particles, nodes);
  }
}

void cover(const Scene& scene, const std::vector<RigidBody>& bodies, double time_s, Nodes& nodes) {
  const Grid& grid = nodes.mesh.grid();
  double diagonal = 0.0;  // of a whole cell
  for (int a = 0; a < grid.dim; ++a) diagonal += scene.grid.spacing(a) * scene.grid.spacing(a);
  diagonal = std::sqrt(diagonal);
  const auto covered = [&](int node) { return covered_volume(grid, node, bodies); };
  for (int i = 0; i < nodes.count(); ++i) {
    const int node = nodes.index[static_cast<std::size_t>(i)];
    const Eigen::Vector3d x = grid.position(node);
    const bool near = std::any_of(bodies.begin(), bodies.end(), [&](const RigidBody& body) {
      return distance_to(body, grid.dim, x).value < diagonal;
    });
    if (near) nodes.covered[i] = nodes.mesh.integral(node, covered);
    const double open = open_share(scene, nodes, node, time_s);
    nodes.covered[i] += (1.0 - open) * (nodes.volume[i] - nodes.covered[i]);
  }
}

}  // namespace conebench::mpm
