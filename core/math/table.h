#pragma once

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <memory>

namespace glimt {

/// Columns of floats, each 64-byte aligned and padded with zeros to a multiple of 32.
template <class ColumnType>
class Table {
 public:
  static constexpr int padding = 32;  ///< the length of a column is a multiple of this

  Table() : Table(0) {}
  explicit Table(int rows, int columns = static_cast<int>(ColumnType::count))
      : rows_(rows),
        stride_((rows + padding - 1) / padding * padding),
        data_(allocate(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(columns))) {}

  int rows() const { return rows_; }
  /// Number of floats from one column to the next.
  int stride() const { return stride_; }
  float* operator[](ColumnType c) { return data_.get() + static_cast<std::ptrdiff_t>(c) * stride_; }
  const float* operator[](ColumnType c) const { return data_.get() + static_cast<std::ptrdiff_t>(c) * stride_; }

 private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  static std::unique_ptr<float[], Free> allocate(std::size_t floats) {
    std::unique_ptr<float[], Free> p(floats ? static_cast<float*>(std::aligned_alloc(64, floats * sizeof(float)))
                                            : nullptr);
    for (std::size_t i = 0; i < floats; ++i) p[i] = 0;
    return p;
  }
  int rows_;
  int stride_;
  std::unique_ptr<float[], Free> data_;
};

/// A row of a table, for writing.
template <class ColumnType>
struct TableRow {
  Table<ColumnType>& table;
  std::size_t row;

  void set(ColumnType c, double value) const { table[c][row] = static_cast<float>(value); }
  /// Writes a vector to this column and the two after it.
  template <class Vector>
  void set3(ColumnType first, const Vector& v) const {
    for (int k = 0; k < 3; ++k) set(static_cast<ColumnType>(static_cast<int>(first) + k), v[k]);
  }
  void set_int(ColumnType c, std::int32_t value) const { table[c][row] = std::bit_cast<float>(value); }
};

}  // namespace glimt
