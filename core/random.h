// SPDX-License-Identifier: Apache-2.0
// Random numbers that are the same on every machine: the standard fixes what mt19937_64 yields but
// not what its distributions make of it, so the conversion is our own.
#pragma once

#include <cstdint>
#include <random>

namespace stroma {

class UniformRandom {
 public:
  explicit UniformRandom(std::uint64_t seed) : engine_(seed) {}

  // Uniform in [0, 1), a multiple of 2^-53.
  [[nodiscard]] double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace stroma
