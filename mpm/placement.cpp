#include "mpm/placement.h"

#include <algorithm>
#include <random>

#include "problems/error.h"

namespace conebench::mpm {
namespace {

// In [-1, 1), from the generator's bits alone: distributions differ between standard libraries.
double symmetric_unit(std::mt19937_64& random) {
  return 2.0 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1.0;
}

void fill(const Scene& scene, const Block& block, const std::vector<RigidBody>& bodies,
          std::mt19937_64& random, Particles& particles) {
  const Grid& grid = scene.grid;
  Eigen::Vector3i count = Eigen::Vector3i::Ones();
  Eigen::Vector3d room = Eigen::Vector3d::Zero();
  double volume = block.fraction;
  for (int a = 0; a < grid.dim; ++a) {
    const double size = block.high_m[a] - block.low_m[a];
    const double wanted = size / grid.spacing(a) * static_cast<double>(block.particles_per_cell);
    count[a] = std::max(1, static_cast<int>(std::lround(wanted)));
    room[a] = size / count[a];
    volume *= room[a];
  }
  const double cohesion = scene.material.cohesion_Pa * block.cohesion_factor;
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) {
        Eigen::Vector3d at = block.low_m;
        const Eigen::Vector3d place(x + 0.5, y + 0.5, z + 0.5);
        for (int a = 0; a < grid.dim; ++a) {
          at[a] += room[a] * (place[a] + 0.5 * block.jitter * symmetric_unit(random));
        }
        const bool taken = std::any_of(bodies.begin(), bodies.end(), [&](const RigidBody& body) {
          return distance_to(body, grid.dim, at).value < 0.0;
        });
        if (!taken) particles.add(at, block.velocity_m_s, volume, cohesion);
      }
    }
  }
}

}  // namespace

Particles place_particles(const Scene& scene, const std::vector<RigidBody>& bodies) {
  std::mt19937_64 random(static_cast<std::uint64_t>(scene.seed));
  Particles particles;
  for (const Block& block : scene.blocks) fill(scene, block, bodies, random, particles);
  problems::require(particles.count() > 0, scene.name,
                    "blocks: no particles are left outside the bodies, expected some");
  return particles;
}

}  // namespace conebench::mpm
