// SPDX-License-Identifier: Apache-2.0
// Rows of different length in one array. Every row owns a capacity; one that outgrows it moves to
// the end of the array, so that changing a row costs what the row is long and no other row moves.
// The place it leaves stays unused.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "core/types.h"

namespace stroma {

struct Row {
  Index begin = 0, size = 0, capacity = 0;
};

// The row gets room for `size` entries, at the end of the array with `spare` more where it has not,
// and that size. Entries it had are kept, as far as they fit.
template <class T>
void resizeRow(Row& row, std::vector<T>& entries, Index size, Index spare) {
  if (size > row.capacity) {
    const auto end = static_cast<Index>(entries.size());
    entries.resize(entries.size() + static_cast<std::size_t>(size + spare));
    std::copy_n(entries.begin() + row.begin, row.size, entries.begin() + end);
    row.begin = end;
    row.capacity = size + spare;
  }
  row.size = size;
}

template <class T>
void assignRow(Row& row, std::vector<T>& entries, std::span<const std::type_identity_t<T>> values,
               Index spare) {
  resizeRow(row, entries, static_cast<Index>(values.size()), spare);
  std::copy(values.begin(), values.end(), entries.begin() + row.begin);
}

// Puts an entry at a position of the row; those from there on move up.
template <class T>
void insertInRow(Row& row, std::vector<T>& entries, Index position,
                 const std::type_identity_t<T>& entry, Index spare) {
  resizeRow(row, entries, row.size + 1, spare);
  const auto at = entries.begin() + row.begin + position;
  std::move_backward(at, entries.begin() + row.begin + row.size - 1,
                     entries.begin() + row.begin + row.size);
  *at = entry;
}

// Room for about a quarter more: a step in which an array must be moved takes long.
template <class T>
void reserveMore(std::vector<T>& entries) {
  entries.reserve(entries.size() + entries.size() / 4 + 4096);
}

template <class T>
void eraseFromRow(Row& row, std::vector<T>& entries, Index position) {
  const auto at = entries.begin() + row.begin + position;
  std::move(at + 1, entries.begin() + row.begin + row.size, at);
  --row.size;
}

}  // namespace stroma
