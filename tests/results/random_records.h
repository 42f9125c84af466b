#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "make_record.h"

namespace conebench::results {

/// What a campaign may leave: scenes of several steps, solvers of different speed, failures of
/// every kind, tasks that were never run, curves, repetitions.
struct RandomResults {
  int scenes = 6, steps = 4, solvers = 4, repetitions = 2;
  double failed_share = 0.2, not_run_share = 0.0;
};

inline std::vector<Record> random_records(std::uint32_t seed, const RandomResults& wanted = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Record> records;
  for (int scene = 0; scene < wanted.scenes; ++scene) {
    for (int step = 0; step < wanted.steps; ++step) {
      for (int solver = 0; solver < wanted.solvers; ++solver) {
        if (uniform(random) < wanted.not_run_share) continue;
        for (int repetition = 0; repetition < wanted.repetitions; ++repetition) {
          const bool fails = uniform(random) < wanted.failed_share;
          const double time_s = std::exp(6.0 * uniform(random)) * 1e-4 * (solver + 1);
          Record record = make_record("scene-" + std::to_string(scene) + "_" + std::to_string(step),
                                      std::string(1, static_cast<char>('a' + solver)),
                                      fails ? 1e-3 : 1e-9, time_s);
          record.problem.family = "dem/scene-" + std::to_string(scene);
          record.repetition = repetition;
          record.iterations = 1 + static_cast<int>(100 * uniform(random));
          record.curve = {{0.1 * time_s, 1, 1e-2}, {time_s, record.iterations, record.eta}};
          if (uniform(random) < 0.5) record.curve.clear();
          if (fails && uniform(random) < 0.5) {
            record.status = Status::kKilledTime;
            record.eta = Record::kUnknown;
            record.curve.clear();
          }
          records.push_back(record);
        }
      }
    }
  }
  return records;
}

inline std::vector<Record> shuffled(std::vector<Record> records, std::uint32_t seed) {
  std::shuffle(records.begin(), records.end(), std::mt19937(seed));
  return records;
}

}  // namespace conebench::results
