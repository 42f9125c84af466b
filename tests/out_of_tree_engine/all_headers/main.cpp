#include "includes.h"  // every installed header

using namespace conebench;

// One thing of each library, so that each is linked.
int main() {
  const bool all_there = solvers::make_solver("gs").name == "gs" &&
                         dem::builtin_scenes().size() > 1 && mpm::builtin_scenes().size() > 1 &&
                         !results::quantity_names().empty();
  return all_there ? 0 : 1;
}
