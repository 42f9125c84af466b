// One call of HierarchicalGrid::find_pairs on packings, dust and mixes of sizes.
//
//   build/broad_phase_benchmark
//
// `things` are balls and boxes together, `pairs` candidates of all three kinds; the time
// per_thing should not grow with the number of things but by what the caches no longer hold.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dem/hierarchical_grid.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 1e-3, kMargin = 1e-4;  // [m]

struct Things {
  std::vector<Vector3d> centres;
  std::vector<double> radii;
  std::vector<Bounds> boxes;
};

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3d place(double extent) {
    return {between(0.0, extent), between(0.0, extent), between(0.0, extent)};
  }
  template <class Item>
  void shuffle(std::vector<Item>& items) {
    std::shuffle(items.begin(), items.end(), engine_);
  }

 private:
  std::mt19937 engine_;
};

// The densest lattice, 2 % wider and shaken; radii differ by a fifth. In the order of the lattice.
Things packing(std::int64_t count) {
  Random random;
  Things things;
  const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count))));
  for (std::int64_t k = 0; k < count; ++k) {
    const auto x = static_cast<int>(k % side), y = static_cast<int>(k / side % side),
               z = static_cast<int>(k / side / side);
    const Vector3d lattice(2 * x + (y + z) % 2, std::sqrt(3.0) * (y + z % 2 / 3.0),
                           std::sqrt(8.0 / 3.0) * z);
    things.centres.push_back(kRadius * (1.02 * lattice + random.place(0.08)));
    things.radii.push_back(kRadius * random.between(0.8, 1.2));
  }
  return things;
}

// As after much mixing: neighbours in space are far apart in memory.
Things mixed_packing(std::int64_t count) {
  Things things = packing(count);
  Random().shuffle(things.centres);
  return things;
}

// A drum's wall of 64 staves, each as long as the packing and a tenth as wide.
Things packing_in_staves(std::int64_t count) {
  Things things = packing(count);
  const double extent = 2.0 * kRadius * std::cbrt(static_cast<double>(count));
  const Vector3d half(0.05 * extent, 0.5 * extent, 0.05 * extent);
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 64.0;
    const Vector3d centre = extent * Vector3d(0.5 + std::cos(angle), 0.5, 0.5 + std::sin(angle));
    things.boxes.push_back({centre - half, centre + half});
  }
  return things;
}

Things packing_between_sheets(std::int64_t count) {
  Things things = packing(count);
  const double extent = 2.0 * kRadius * std::cbrt(static_cast<double>(count));
  for (int k = 0; k < 1000; ++k) {
    const double z = extent * k / 1000.0;
    things.boxes.push_back({{-extent, -extent, z}, {2 * extent, 2 * extent, z + 1e-4 * extent}});
  }
  return things;
}

// Equal, with ten times a diameter between them.
Things dust(std::int64_t count) {
  Random random;
  Things things;
  const double extent = 20.0 * kRadius * std::cbrt(static_cast<double>(count));
  for (std::int64_t k = 0; k < count; ++k) {
    things.centres.push_back(random.place(extent));
    things.radii.push_back(kRadius);
  }
  return things;
}

// Balls over three decades, as much volume in each octave of sizes: half of space is filled.
Things power_law(std::int64_t count) {
  Random random;
  Things things;
  double volume = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const double radius = kRadius / std::cbrt(random.between(1e-9, 1.0));
    things.radii.push_back(radius);
    volume += 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  for (std::int64_t k = 0; k < count; ++k) {
    things.centres.push_back(random.place(std::cbrt(2.0 * volume)));
  }
  return things;
}

Things bricks(std::int64_t count) {
  Things things;
  const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count))));
  for (std::int64_t k = 0; k < count; ++k) {
    const auto x = static_cast<int>(k % side), y = static_cast<int>(k / side % side),
               z = static_cast<int>(k / side / side);
    const Vector3d low(0.2 * x + 0.1 * (z % 2), 0.1 * y, 0.06 * z);
    things.boxes.push_back({low, low + Vector3d(0.2, 0.1, 0.06)});
  }
  return things;
}

void find_pairs(benchmark::State& state, Things (*make)(std::int64_t)) {
  const Things things = make(state.range(0));
  HierarchicalGrid grid;
  Candidates found;
  for (auto _ : state) {
    grid.find_pairs(things.centres, things.radii, things.boxes, kMargin, found);
    benchmark::DoNotOptimize(found.balls.data());
  }
  const auto count = static_cast<double>(things.centres.size() + things.boxes.size());
  state.counters["things"] = count;
  state.counters["pairs"] =
      static_cast<double>(found.balls.size() + found.ball_box.size() + found.boxes.size());
  state.counters["per_thing"] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->RangeMultiplier(10)->Range(10'000, 1'000'000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(find_pairs, packing, packing)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, mixed_packing, mixed_packing)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, packing_in_staves, packing_in_staves)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, packing_between_sheets, packing_between_sheets)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, dust, dust)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, power_law, power_law)->Apply(sizes);
BENCHMARK_CAPTURE(find_pairs, bricks, bricks)->Apply(sizes);

}  // namespace
}  // namespace conebench::dem

BENCHMARK_MAIN();
