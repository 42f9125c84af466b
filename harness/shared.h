#pragma once

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace conebench::harness {

/// A value that never changes, kept once however often it is copied: what many tasks have in
/// common. Every worker's fork pays for the memory of the campaign.
template <class T>
class Shared {
 public:
  Shared(T value) : value_(std::make_shared<const T>(std::move(value))) {}  // NOLINT: implicit

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }

 private:
  std::shared_ptr<const T> value_;
};

template <class T>
class SharedList : public Shared<std::vector<T>> {
 public:
  using Shared<std::vector<T>>::Shared;
  SharedList(std::initializer_list<T> values) : Shared<std::vector<T>>(std::vector<T>(values)) {}
};

}  // namespace conebench::harness
