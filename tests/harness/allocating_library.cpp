// A library that measures_test.cpp loads while it runs.

#include <cstdlib>

extern "C" void allocate(int blocks) {
  for (int i = 0; i < blocks; ++i) {
    void* volatile block = std::malloc(64);
    std::free(block);
  }
}
