// SPDX-License-Identifier: Apache-2.0
// Cantilevers of 0.4 x 0.1 x 0.1 m, 10 kPa, Poisson's ratio 0.33, 1000 kg/m^3, as scenes.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/interfaces/observer.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma::test {

inline const std::string tetrahedra =
    "<TetrahedronFEMForceField name=\"fem\" youngModulus=\"10000\" poissonRatio=\"0.33\"/>";
inline const std::string hexahedra =
    "<HexahedronFEMForceField name=\"fem\" youngModulus=\"10000\" poissonRatio=\"0.33\"/>";
inline const std::string springs = "<MeshSpringForceField name=\"fem\" stiffness=\"5\"/>";

struct Beam {
  std::string solver, forceField, points, split = "six", gravity = "0 0 -0.1", dt = "1";
};

inline std::unique_ptr<Scene> load(const Beam& beam) {
  SceneOptions options;
  options.pluginFolders = {STROMA_MODULES_FOLDER};
  options.writesOutput = false;
  auto scene = std::make_unique<Scene>(options);
  const std::string text = "<Node name=\"root\" dt=\"" + beam.dt + "\" gravity=\"" + beam.gravity +
                           "\"><Node name=\"beam\">" + beam.solver +
                           "<RegularGridTopology name=\"grid\" n=\"" + beam.points +
                           "\" min=\"0 0 0\" max=\"0.4 0.1 0.1\" createTetrahedra=\"" + beam.split +
                           "\"/><MechanicalObject name=\"state\"/>"
                           "<DiagonalMass name=\"mass\" massDensity=\"1000\"/>" +
                           beam.forceField +
                           "<BoxROI name=\"wall\" box=\"-1 -1 -1 0.0001 1 1\"/>"
                           "<BoxROI name=\"tip\" box=\"0.3999 -1 -1 1 1 1\"/>"
                           "<FixedProjectiveConstraint indices=\"@wall.indices\"/>"
                           "<Monitor name=\"deflection\" indices=\"@tip.indices\" component=\"z\" "
                           "quantity=\"displacement\" reduce=\"mean\"/></Node></Node>";
  EXPECT_TRUE(scene->loadText(text, "beam.xml") && scene->initialise())
      << scene->diagnostics().text();
  EXPECT_EQ(scene->diagnostics().warningCount(), 0) << scene->diagnostics().text();
  return scene;
}

// Displacement of the end, the mean of its face (m).
inline double tipOf(Scene& scene) {
  for (const Observer* observer : collect<Observer>(scene.root()))
    for (const auto& [name, value] : observer->lastValues()) return value;
  ADD_FAILURE() << "no monitor";
  return 0;
}

inline double tipAfter(const Beam& beam, int steps) {
  const auto scene = load(beam);
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(scene->step());
  return tipOf(*scene);
}

}  // namespace stroma::test
