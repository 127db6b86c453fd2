// SPDX-License-Identifier: Apache-2.0
// Exact copies of a simulation's state: time, positions, velocities and what components add.
// Restoring one continues with the same bits as if the run had not stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/types.h"

namespace stroma {

// Named chunks of plain numbers.
using SnapshotChunks = std::map<std::string, std::vector<std::byte>, std::less<>>;

struct Snapshot {
  std::uint64_t step = 0;
  double time = 0;
  SnapshotChunks chunks;
};

// A component writes its values under its own path: writer.write("factorPositions", span).
class StateWriter {
 public:
  StateWriter(SnapshotChunks& chunks, std::string prefix)
      : chunks_(chunks), prefix_(std::move(prefix)) {}
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void write(std::string_view name, std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    chunks_[prefix_ + "#" + std::string(name)].assign(bytes.begin(), bytes.end());
  }
  void write(std::string_view name, ConstVec3Span values) {
    write(name, std::span<const double>(values.empty() ? nullptr : values.front().data(),
                                        3 * values.size()));
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void write(std::string_view name, T value) { write(name, std::span<const T>(&value, 1)); }

 private:
  SnapshotChunks& chunks_;
  std::string prefix_;
};

class StateReader {
 public:
  StateReader(const SnapshotChunks& chunks, std::string prefix)
      : chunks_(chunks), prefix_(std::move(prefix)) {}
  // False when the chunk is missing or has another size; the values are then unchanged.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool read(std::string_view name, std::span<T> values) const {
    const auto at = chunks_.find(prefix_ + "#" + std::string(name));
    if (at == chunks_.end() || at->second.size() != values.size_bytes()) return false;
    if (!values.empty()) std::memcpy(values.data(), at->second.data(), values.size_bytes());
    return true;
  }
  [[nodiscard]] bool read(std::string_view name, Vec3Span values) const {
    return read(name, std::span<double>(values.empty() ? nullptr : values.front().data(),
                                        3 * values.size()));
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] bool read(std::string_view name, T& value) const {
    return read(name, std::span<T>(&value, 1));
  }
  // Number of values of type T in a chunk, 0 when it is missing.
  template <class T>
  [[nodiscard]] std::size_t count(std::string_view name) const {
    const auto at = chunks_.find(prefix_ + "#" + std::string(name));
    return at == chunks_.end() ? 0 : at->second.size() / sizeof(T);
  }

 private:
  const SnapshotChunks& chunks_;
  std::string prefix_;
};

// A checkpoint file holds a snapshot, the build id and a hash of the scene that made it.
// Both return an empty string, or what went wrong.
[[nodiscard]] std::string writeCheckpoint(const std::string& file, const Snapshot& snapshot,
                                          std::uint64_t sceneHash);
[[nodiscard]] std::string readCheckpoint(const std::string& file, Snapshot& snapshot,
                                         std::uint64_t sceneHash);

// FNV-1a over bytes, for comparing scenes and states.
[[nodiscard]] std::uint64_t hashBytes(std::span<const std::byte> bytes,
                                      std::uint64_t seed = 0xcbf29ce484222325ULL);

}  // namespace stroma
