#pragma once

#include <string>

#include "problems/error.h"

namespace conebench::harness {

/// The error that a child process has met, from its what() and its subject.
inline problems::InputError input_error(const std::string& what, const std::string& subject) {
  const bool named = what.starts_with(subject + ": ");
  return {subject, named ? what.substr(subject.size() + 2) : what};
}

}  // namespace conebench::harness
