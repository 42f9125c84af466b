#include "dem/generators/stack.h"

#include <fmt/format.h>

#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

Stack read_stack(engine::TomlReader in) {
  Stack stack;
  stack.base_m = in.vector("base_m", stack.base_m);
  stack.count = in.integer("count", 1);
  stack.radius_m = in.number("radius_m", Range::kPositive);
  stack.growth = in.number("growth", Range::kPositive, stack.growth);
  stack.material = in.text("material");
  in.finish();
  return stack;
}

std::string show(const Stack& stack) {
  return fmt::format(
      "\n[[stacks]]\nbase_m = {}\ncount = {}\nradius_m = {}\ngrowth = {}\nmaterial = {}\n",
      engine::show(stack.base_m), stack.count, stack.radius_m, stack.growth,
      engine::quote(stack.material));
}

void place(const Stack& stack, Nursery& nursery) {
  Seedling ball;
  ball.radius_m = stack.radius_m;
  ball.pose.position = stack.base_m;
  ball.pose.position.z() += stack.radius_m;
  ball.material = stack.material;
  for (std::int64_t i = 0; i < stack.count; ++i) {
    nursery.add(ball);
    const double next = stack.growth * ball.radius_m;
    ball.pose.position.z() += ball.radius_m + next;
    ball.radius_m = next;
  }
}

}  // namespace conebench::dem
