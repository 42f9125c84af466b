#include "dem/heap.h"

#include <cmath>
#include <numbers>

namespace conebench::dem {
namespace {

constexpr double kColumn = 3.0;  // in radii: one grain wide, and the gap to the next

double radius_of(const Scene& scene, const Bodies& bodies, int body) {
  const auto b = static_cast<std::size_t>(body);
  if (bodies.is_ball(body)) return bodies.radius[b];
  const Material& material = scene.materials[static_cast<std::size_t>(bodies.material[b])];
  return std::cbrt(0.75 / std::numbers::pi * bodies.mass[b] / material.density_kg_m3);
}

}  // namespace

engine::Heap heap_of(const Simulation& simulation) {
  const Bodies& bodies = simulation.bodies();
  engine::Heap heap;
  double radii = 0.0;
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    heap.grains.push_back({.position = bodies.position[b],
                           .mass = bodies.mass[b],
                           .radius = radius_of(simulation.scene(), bodies, i)});
    radii += heap.grains.back().radius;
  }
  heap.cell_m = kColumn * radii / static_cast<double>(heap.grains.size());
  return heap;
}

}  // namespace conebench::dem
