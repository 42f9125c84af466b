#include "problems/scaled_rows.h"

#include <algorithm>

namespace conebench::problems {
namespace {

// Calls use(row, column, H(first + row, j) F(j, column)) for every such product.
template <class Use>
void each_product(const SparseMatrix& H, const SparseMatrix& F, int first, int count, Use use) {
  for (int row = 0; row < count; ++row) {
    for (SparseMatrix::InnerIterator h(H, first + row); h; ++h) {
      for (SparseMatrix::InnerIterator f(F, h.col()); f; ++f) {
        use(row, static_cast<std::size_t>(f.col()), h.value() * f.value());
      }
    }
  }
}

}  // namespace

void ScaledRows::load(int first, int count) {
  rows_ = count;
  columns_.clear();
  each_product(H_, F_, first, count, [this](int, std::size_t column, double) {
    if (slot_[column] >= 0) return;
    slot_[column] = 0;
    columns_.push_back(static_cast<int>(column));
  });
  std::ranges::sort(columns_);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    slot_[static_cast<std::size_t>(columns_[k])] = static_cast<int>(k);
  }
  values_.assign(static_cast<std::size_t>(count) * columns_.size(), 0.0);
  each_product(H_, F_, first, count, [this](int row, std::size_t column, double value) {
    values_[static_cast<std::size_t>(slot_[column] * rows_ + row)] += value;
  });
  for (const int column : columns_) slot_[static_cast<std::size_t>(column)] = -1;
}

}  // namespace conebench::problems
