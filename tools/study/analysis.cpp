// SPDX-License-Identifier: Apache-2.0
#include "tools/study/analysis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

namespace stroma::study {
namespace {

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(number) < 1000 ? "%.3g" : "%.0f", number);
  return text;
}

std::string percent(double share) { return rounded(100 * share) + " %"; }

const Point* best(std::span<const Point> points, double Point::*wanted, double Point::*limited,
                  double limit) {
  const Point* found = nullptr;
  for (const Point& p : points) {
    if (p.*limited <= limit && (!found || p.*wanted < found->*wanted)) found = &p;
  }
  return found;
}

constexpr double unlimited = std::numeric_limits<double>::infinity();

const Point* mostAccurate(std::span<const Point> points) {
  return best(points, &Point::error, &Point::cost, unlimited);
}

// Another method's point that may be as fast as this one: their times overlap.
const Point* asFast(std::span<const Point> points, const Point& fastest, double error) {
  const Point* found = nullptr;
  for (const Point& p : points) {
    const bool overlaps = p.method != fastest.method && p.least <= fastest.most;
    if (overlaps && p.error <= error && (!found || p.cost < found->cost)) found = &p;
  }
  return found;
}

// What each method needs for the error, in the order in which methods appear.
std::string eachMethod(std::span<const Point> points, double error, const std::string& cost) {
  std::vector<std::string> methods;
  for (const Point& p : points) {
    if (std::ranges::find(methods, p.method) == methods.end()) methods.push_back(p.method);
  }
  if (methods.size() < 2) return "";
  std::string text;
  for (const std::string& method : methods) {
    std::vector<Point> own;
    std::ranges::copy_if(points, std::back_inserter(own),
                         [&](const Point& p) { return p.method == method; });
    const Point* cheapest = best(own, &Point::cost, &Point::error, error);
    text += text.empty() ? "" : "; ";
    text += method + (cheapest
                          ? " " + rounded(cheapest->cost) + " " + cost
                          : " does not get there (best " + percent(mostAccurate(own)->error) + ")");
  }
  return "What each method needs for " + percent(error) + " error: " + text + ".";
}

}  // namespace

std::vector<std::size_t> paretoFront(std::span<const Point> points) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].cost, points[a].error) < std::pair(points[b].cost, points[b].error);
  });
  for (const std::size_t i : order) {
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  }
  return front;
}

std::optional<Order> fitOrder(std::vector<std::pair<double, double>> pairs) {
  constexpr std::size_t finest = 3;
  std::ranges::sort(pairs);
  pairs.resize(std::min(pairs.size(), finest));
  double meanX = 0, meanY = 0, xx = 0, xy = 0;
  for (const auto& [h, error] : pairs) {
    if (!(h > 0) || !(error > 0)) return std::nullopt;
    meanX += std::log(h) / static_cast<double>(pairs.size());
    meanY += std::log(error) / static_cast<double>(pairs.size());
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0 && pairs[i].first == pairs[i - 1].first) return std::nullopt;
    const double x = std::log(pairs[i].first) - meanX;
    xx += x * x;
    xy += x * (std::log(pairs[i].second) - meanY);
  }
  if (pairs.size() < finest) return std::nullopt;
  return Order{xy / xx, static_cast<int>(pairs.size())};
}

std::vector<std::string> sentences(std::span<const Point> points, const Budgets& budgets) {
  if (points.empty()) return {"No variation gave an error to compare."};
  const auto figures = [&](const Point& p) {
    return p.label + " (" + rounded(p.cost) + " " + budgets.cost + ", " + percent(p.error) +
           " error)";
  };
  std::vector<std::string> said;
  for (const double error : budgets.errors) {
    if (const Point* fastest = best(points, &Point::cost, &Point::error, error)) {
      const Point* rival = asFast(points, *fastest, error);
      said.push_back("At " + percent(error) + " error the fastest is " + figures(*fastest) +
                     (rival ? "; within the spread of the times so is " + figures(*rival) : "") +
                     ".");
    } else {
      said.push_back("None reaches " + percent(error) + " error: the best is " +
                     figures(*mostAccurate(points)) + ".");
    }
    if (std::string all = eachMethod(points, error, budgets.cost); !all.empty()) {
      said.push_back(std::move(all));
    }
  }
  for (const double ms : budgets.ms) {
    const Point* within = best(points, &Point::error, &Point::cost, ms);
    const Point* cheapest = best(points, &Point::cost, &Point::error, unlimited);
    const std::string limit = rounded(ms) + " " + budgets.cost;
    said.push_back(within ? "Within " + limit + " the most accurate is " + figures(*within) + "."
                          : "None stays within " + limit + ": the fastest is " +
                                figures(*cheapest) + ".");
  }
  if (said.empty()) said.push_back("The most accurate is " + figures(*mostAccurate(points)) + ".");
  return said;
}

std::string orderOfCosts(std::vector<Point> points, const std::string& cost) {
  if (points.empty()) return "No variation was run to its end.";
  std::ranges::stable_sort(points, {}, &Point::cost);
  const Point& first = points.front();
  std::string text =
      "The fastest is " + first.label + " (" + rounded(first.cost) + " " + cost + ")";
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& p = points[i];
    text += (i == 1 ? "; then " : ", ") + p.label + " (" + rounded(p.cost) + ", " +
            rounded(p.cost / first.cost) + " times" +
            (p.least <= first.most ? ", within the spread)" : ")");
  }
  return text + ".";
}

std::string beside(const std::string& published, double ms, const Point& ours) {
  return published + ": " + rounded(ms) + " ms, " + rounded(ms / ours.cost) + " times " +
         ours.label + " (" + rounded(ours.cost) + " ms), on another machine.";
}

}  // namespace stroma::study
