// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/types.h"

namespace stroma {

// Positions and velocities for a state to start from, made of its rest positions. In this order:
//
//   scramble     every particle anywhere in the body's bounds, uniformly
//   deformation  x -> c + F (x - c), c the mean of the points
//   twist        turned about x by this angle a metre, from the end where x is least
//   checkerboard moved by (-1)^(i + j + k) `checkerboard` along every axis, with i, j, k from the
//                order of a lattice of `n` points
//   noise        every coordinate by up to this much
//
// Velocities are v + w x (x - c) at the positions so made. A scene takes them over:
//
//   <InitialMotion name="start" points="@grid.position" scramble="true"/>
//   <MechanicalObject rest_position="@grid.position" position="@start.position"
//                     velocity="@start.velocity"/>
class InitialMotion final : public Component {
 public:
  static constexpr std::string_view role = "InitialMotion";

  Attribute<std::vector<Vec3>> points{
      this, "points", {}, "Rest positions.", {.unit = "m", .required = true}};
  Attribute<bool> scramble{this, "scramble", false,
                           "Puts every particle anywhere in the body's bounds."};
  Attribute<std::vector<double>> deformation{
      this, "deformation", {1, 0, 0, 0, 1, 0, 0, 0, 1}, "Linear map about the middle, by rows."};
  Attribute<double> twist{
      this, "twist", 0.0, "Turn about the x axis through the middle, along x.", {.unit = "rad/m"}};
  Attribute<double> checkerboard{this,
                                 "checkerboard",
                                 0.0,
                                 "Moves neighbours on a lattice of n points to opposite sides.",
                                 {.unit = "m"}};
  Attribute<std::vector<int>> n{
      this, "n", {}, "Points of the lattice along x, y and z.", {.min = 1}};
  Attribute<double> noise{
      this, "noise", 0.0, "Moves every coordinate by up to this much.", {.unit = "m", .min = 0}};
  Attribute<int> seed{this, "seed", 1, "Of scramble and noise.", {.min = 0}};
  Attribute<Vec3> linearVelocity{
      this, "linearVelocity", Vec3::Zero(), "Of all particles.", {.unit = "m/s"}};
  Attribute<Vec3> angularVelocity{
      this, "angularVelocity", Vec3::Zero(), "Spin about the middle.", {.unit = "rad/s"}};

  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Where the particles start.", {.unit = "m", .output = true}};
  Attribute<std::vector<Vec3>> velocity{
      this, "velocity", {}, "Their velocities there.", {.unit = "m/s", .output = true}};
  Attribute<std::vector<Vec3>> displacement{
      this, "displacement", {}, "From rest to there.", {.unit = "m", .output = true}};

  void configure() override;
  void bind() override;
};

}  // namespace stroma
