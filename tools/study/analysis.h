// SPDX-License-Identifier: Apache-2.0
// What the figures of a question say: the choices nobody beats, orders of convergence, and answers
// in words.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stroma::study {

// One variation that was run: what it costs (ms) and how far off it is (relative).
struct Point {
  std::string method, label;
  double cost = 0, error = 0;
  double least = 0, most = 0;  // of the cost, over repeated runs
};

// Indices of the points that no other point beats in both, by rising cost.
[[nodiscard]] std::vector<std::size_t> paretoFront(std::span<const Point> points);

struct Order {
  double order = 0;
  int points = 0;  // that it was fitted to
};

// The p of error = C h^p by least squares of the logarithms, over the three finest of the pairs
// (h, error); none for fewer than three different h, or errors that are zero.
[[nodiscard]] std::optional<Order> fitOrder(std::vector<std::pair<double, double>> pairs);

struct Budgets {
  std::vector<double> errors, ms;
  std::string cost = "ms a step";  // what a cost is called
};

// "At 5 % error the fastest is ..." (with who is as fast within the spread of times), "Within 1 ms
// a step the most accurate is ...", and for several methods what each needs for the error.
[[nodiscard]] std::vector<std::string> sentences(std::span<const Point> points,
                                                 const Budgets& budgets);

// Where nothing has an error to compare: every point by rising cost, beside the cheapest.
[[nodiscard]] std::string orderOfCosts(std::vector<Point> points, const std::string& cost);
// "... took 18 ms, 140 times ours (...)": a published cost beside the point it is set against.
[[nodiscard]] std::string beside(const std::string& published, double ms, const Point& ours);

}  // namespace stroma::study
