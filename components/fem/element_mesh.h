// SPDX-License-Identifier: Apache-2.0
// The rest state of a mesh of one kind of element, packed for the force loops: gradients of the
// shape functions at the quadrature points, F_q = sum_a (x_a - x_0) g_qa^T (node 0 has minus the
// sum of the others' gradients), weights w_q (m^3), and for every node the places where elements
// have it.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <vector>

#include "components/fem/elements.h"
#include "core/element_body.h"

namespace stroma {

template <class Element>
class ElementMesh {
 public:
  using Nodes = std::array<Index, Element::nodes>;
  struct Point {
    std::array<Vec3, Element::nodes - 1> gradients;  // of nodes 1, 2, ..., 1/m
    double weight;
  };

  // Elements that are inverted at a point or have (nearly) no volume there.
  [[nodiscard]] static ElementFlaw findFlaw(ConstVec3Span rest, std::span<const Nodes> elements) {
    ElementFlaw flaw;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (isSound(rest, elements[e])) continue;
      if (flaw.count++ == 0) flaw.first = static_cast<Index>(e);
    }
    return flaw;
  }

  // Every element must name points of `rest` and be without flaw.
  ElementMesh(ConstVec3Span rest, std::span<const Nodes> elements)
      : elements_(elements.begin(), elements.end()), begin_(rest.size() + 1, 0) {
    points_.reserve(elements.size() * Element::points);
    for (const Nodes& nodes : elements_)
      for (int q = 0; q < Element::points; ++q) points_.push_back(pointOf(rest, nodes, q));
    for (const Nodes& nodes : elements_)
      for (const Index i : nodes) ++begin_[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 0; i < rest.size(); ++i) begin_[i + 1] += begin_[i];
    places_.resize(elements_.size() * Element::nodes);
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    Index place = 0;
    for (const Nodes& nodes : elements_)
      for (const Index i : nodes)
        places_[static_cast<std::size_t>(next[static_cast<std::size_t>(i)]++)] = place++;
  }

  [[nodiscard]] Index nodeCount() const { return static_cast<Index>(begin_.size()) - 1; }
  [[nodiscard]] Index elementCount() const { return static_cast<Index>(elements_.size()); }
  [[nodiscard]] const Nodes& nodes(Index e) const { return elements_[e]; }
  [[nodiscard]] const Point& point(Index e, int q) const {
    return points_[e * Element::points + q];
  }
  // Places (element * nodes + corner) of a node, ascending.
  [[nodiscard]] std::span<const Index> placesOf(Index node) const {
    return std::span(places_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
  }

  // The nodes that share an element with each node, itself included, ascending.
  [[nodiscard]] std::vector<std::vector<Index>> neighbours() const {
    std::vector<std::vector<Index>> rows(static_cast<std::size_t>(nodeCount()));
    for (Index i = 0; i < nodeCount(); ++i) {
      auto& row = rows[static_cast<std::size_t>(i)];
      for (const Index place : placesOf(i)) {
        const Nodes& nodes = elements_[place / Element::nodes];
        row.insert(row.end(), nodes.begin(), nodes.end());
      }
      std::ranges::sort(row);
      row.erase(std::ranges::unique(row).begin(), row.end());
    }
    return rows;
  }

 private:
  static Eigen::Matrix<double, 3, Element::nodes> cornersOf(ConstVec3Span rest,
                                                            const Nodes& nodes) {
    Eigen::Matrix<double, 3, Element::nodes> corners;
    for (int a = 0; a < Element::nodes; ++a) corners.col(a) = rest[nodes[a]];
    return corners;
  }
  static bool isSound(ConstVec3Span rest, const Nodes& nodes) {
    const auto corners = cornersOf(rest, nodes);
    double size = 0;
    for (int a = 1; a < Element::nodes; ++a)
      size = std::max(size, (corners.col(a) - corners.col(0)).norm());
    constexpr double flat = 1e-12;
    for (int q = 0; q < Element::points; ++q) {
      const Mat3 jacobian = corners * Element::referenceGradients(q).transpose();
      if (!(jacobian.determinant() > flat * size * size * size)) return false;
    }
    return true;
  }
  static Point pointOf(ConstVec3Span rest, const Nodes& nodes, int q) {
    const auto reference = Element::referenceGradients(q);
    const Mat3 jacobian = cornersOf(rest, nodes) * reference.transpose();
    const Eigen::Matrix<double, 3, Element::nodes> g = jacobian.inverse().transpose() * reference;
    Point point;
    for (int a = 1; a < Element::nodes; ++a) point.gradients[a - 1] = g.col(a);
    point.weight = Element::weight * jacobian.determinant();
    return point;
  }

  std::vector<Nodes> elements_;
  std::vector<Point> points_;
  std::vector<Index> begin_, places_;
};

}  // namespace stroma
