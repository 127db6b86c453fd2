// SPDX-License-Identifier: Apache-2.0
// The scene tree: a node owns child nodes and components, in document order.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/attribute_owner.h"
#include "core/component.h"
#include "core/types.h"

namespace stroma {

class Scene;

class Node final : public AttributeOwner {
 public:
  Node(Scene& scene, Node* parent);

  Attribute<double> dt{this,
                       "dt",
                       0.01,
                       "Time step of the simulation (read from the root node).",
                       {.unit = "s", .min = 0.0, .exclusiveMin = true}};
  Attribute<Vec3> gravity{this,
                          "gravity",
                          Vec3(0, -9.81, 0),
                          "Acceleration of gravity; nodes without a value of their own inherit it. "
                          "It acts on particles that have a mass.",
                          {.unit = "m/s^2"}};
  Attribute<double> duration{
      this,
      "duration",
      1.0,
      "Simulated time that `stroma run` makes unless told otherwise (read from "
      "the root node).",
      {.unit = "s", .min = 0.0}};
  Attribute<double> time{this, "time", 0.0, "Time at which the simulation starts.", {.unit = "s"}};
  Attribute<bool> animate{this, "animate", false, "Whether an interactive session starts running."};
  Attribute<bool> activated{this, "activated", true, "A node that is not activated is left out."};
  Attribute<Box> bbox{this, "bbox", Box{}, "Bounds of the scene, for the camera.", {.unit = "m"}};
  Attribute<std::string> units{
      this, "units", "",
      "Units of bare numbers below this node: length, mass and time, such as "
      "\"mm g s\". Without it they are SI."};

  [[nodiscard]] Scene& scene() const { return *scene_; }
  [[nodiscard]] Node* parent() const { return parent_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Node>>& children() const { return children_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Component>>& components() const {
    return components_;
  }
  // Gravity of this node or of the nearest ancestor that sets it.
  [[nodiscard]] const Vec3& gravityHere() const;

  Node& addChild();
  Component& add(std::unique_ptr<Component> component);

  [[nodiscard]] std::string describe() const override;
  [[nodiscard]] std::string path() const override;

 private:
  Scene* scene_;
  Node* parent_;
  std::vector<std::unique_ptr<Node>> children_;
  std::vector<std::unique_ptr<Component>> components_;
};

}  // namespace stroma
