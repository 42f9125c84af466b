#include "mpm/heap.h"

#include <algorithm>
#include <cmath>

namespace conebench::mpm {

engine::Heap heap_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Particles& particles = simulation.particles();
  engine::Heap heap;
  heap.cell_m = scene.grid.smallest_spacing();
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const double bulk = particles.volume[p] / scene.material.phi_max;
    heap.grains.push_back({.position = particles.position[p],
                           .mass = scene.material.density_kg_m3 * particles.volume[p],
                           .radius = 0.5 * std::pow(bulk, 1.0 / scene.grid.dim)});
  }
  return heap;
}

double overfull_share(const Scene& scene, const Nodes& nodes) {
  constexpr double kLeastOpen = 0.1;  // quadrature of what bodies cover is coarse
  double densest = 0.0;
  for (int i = 0; i < nodes.count(); ++i) {
    const double open = nodes.volume[i] - nodes.covered[i];
    if (open < kLeastOpen * nodes.volume[i]) continue;
    densest = std::max(densest, nodes.solid[i] / (scene.material.phi_max * open));
  }
  return densest - 1.0;
}

}  // namespace conebench::mpm
