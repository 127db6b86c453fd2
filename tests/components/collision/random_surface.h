// SPDX-License-Identifier: Apache-2.0
// Surfaces to test with: bumpy sheets that move at random, and the shipped cornea.
#pragma once

#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/types.h"

namespace stroma::test {

struct Surface {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
};

// n x n squares of the given side in z = 0, front upwards, middle at the origin.
inline Surface grid(int n, double side) {
  Surface s;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) s.x.push_back(side * Vec3(i - 0.5 * n, j - 0.5 * n, 0));
  }
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return s;
}

inline void shake(std::vector<Vec3>& x, std::mt19937& random, double by) {
  std::normal_distribution<double> normal(0, by);
  for (Vec3& p : x) p += Vec3(normal(random), normal(random), normal(random));
}

inline Surface readSurface(const std::string& file) {
  Surface s;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind == "v") {
      Vec3 p;
      words >> p[0] >> p[1] >> p[2];
      s.x.push_back(p);
    } else if (kind == "f") {
      Triangle t;
      for (Index& node : t) {
        words >> word;
        node = std::stoi(word) - 1;
      }
      s.triangles.push_back(t);
    }
  }
  return s;
}

}  // namespace stroma::test
