#include "harness/mode.h"

#include <array>

#include "problems/error.h"

namespace conebench::harness {

std::string_view to_string(Mode mode) {
  switch (mode) {
    case Mode::kCold:
      return "cold";
    case Mode::kWarm:
      return "warm";
    case Mode::kSequence:
      return "sequence";
  }
  return "";
}

Mode mode_from(const std::string& name, std::string_view option) {
  constexpr std::array kModes = {Mode::kCold, Mode::kWarm, Mode::kSequence};
  for (const Mode mode : kModes) {
    if (name == to_string(mode)) return mode;
  }
  throw problems::InputError(std::string(option), "\"" + name + "\"; known: cold, warm, sequence");
}

}  // namespace conebench::harness
