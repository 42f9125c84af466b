#include "problems/engine/step_solver.h"

#include <fmt/format.h>

#include <stdexcept>

namespace conebench::engine {

void check_answer(const StepAnswer& answer, Eigen::Index rows, std::string_view scene,
                  std::int64_t step) {
  if (answer.r.size() == rows && answer.r.allFinite()) return;
  throw std::runtime_error(fmt::format(
      "{}: step {}: the solver (status {}) returned {} numbers, expected {} finite ones", scene,
      step, answer.status, answer.r.size(), rows));
}

}  // namespace conebench::engine
