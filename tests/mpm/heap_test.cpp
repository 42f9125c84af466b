// Sand as a heap: mass, size, and nodes that are fuller than they may be.

#include "mpm/heap.h"

#include <gtest/gtest.h>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;

class SandAsAHeap : public testing::TestWithParam<int> {
 protected:
  // Two cells of sand along each axis, 0.6 of them solid, 2 particles a cell and axis.
  mpm::Scene scene() const {
    mpm::Scene made = box_scene(std::vector<int>(static_cast<std::size_t>(GetParam()), 4));
    add_block(made, Vector3d::Constant(1), Vector3d::Constant(3));
    return made;
  }
  double solid_m3() const { return 0.6 * std::pow(0.2, GetParam()); }
};

TEST_P(SandAsAHeap, HoldsTheMassOfTheSandAroundItsMiddle) {
  const mpm::Simulation simulation(scene(), step_solver("gs", 1e-6));
  const engine::Heap heap = mpm::heap_of(simulation);
  double mass = 0.0;
  for (const engine::Grain& grain : heap.grains) mass += grain.mass;
  EXPECT_NEAR(mass, 1500.0 * solid_m3(), 1e-9);
  EXPECT_TRUE(
      engine::centre_of_mass(heap).isApprox(flat(GetParam(), Vector3d::Constant(0.2)), 1e-12));
  EXPECT_DOUBLE_EQ(heap.cell_m, 0.1);
}

TEST_P(SandAsAHeap, ItsParticlesFillTheirRoomSideBySide) {
  const mpm::Simulation simulation(scene(), step_solver("gs", 1e-6));
  for (const engine::Grain& grain : mpm::heap_of(simulation).grains) {
    EXPECT_NEAR(grain.radius, 0.025, 1e-12);
  }
}

TEST_P(SandAsAHeap, AFullBlockIsNowhereOverfull) {
  const mpm::Scene made = scene();
  EXPECT_NEAR(mpm::overfull_share(made, pose(made, particles_of(made), 1e-3).nodes), 0.0, 1e-12);
}

TEST_P(SandAsAHeap, TwiceTheSandIsTooMuchByAsMuchAgain) {
  const mpm::Scene made = scene();
  mpm::Particles particles = particles_of(made);
  for (double& volume : particles.volume) volume *= 2.0;
  EXPECT_NEAR(mpm::overfull_share(made, pose(made, particles, 1e-3).nodes), 1.0, 1e-12);
}

TEST_P(SandAsAHeap, WithoutSandNoNodeIsFull) {
  EXPECT_EQ(mpm::overfull_share(scene(), mpm::Nodes{}), -1.0);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, SandAsAHeap, testing::Values(2, 3), dimension_name);

}  // namespace
}  // namespace conebench::test
