// SPDX-License-Identifier: Apache-2.0
#include "core/sofa_dialect.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace stroma::sofa {
namespace {

using Names = std::pair<std::string_view, std::string_view>;

constexpr std::array renames = {
    Names{"FixedConstraint", "FixedProjectiveConstraint"},
    Names{"FixedPlaneConstraint", "FixedPlaneProjectiveConstraint"},
    Names{"PartialFixedConstraint", "PartialFixedProjectiveConstraint"},
    Names{"LinearMovementConstraint", "LinearMovementProjectiveConstraint"},
    Names{"StiffSpringForceField", "SpringForceField"},
    Names{"ShewchukPCGLinearSolver", "PCGLinearSolver"},
    Names{"DefaultPipeline", "CollisionPipeline"},
    Names{"DefaultContactManager", "CollisionResponse"},
    Names{"GenericConstraintSolver", "BlockGaussSeidelConstraintSolver"},
    Names{"MeshObjLoader", "MeshOBJLoader"},
    Names{"EulerImplicit", "EulerImplicitSolver"},
    Names{"ImplicitEulerSolver", "EulerImplicitSolver"},
    Names{"ImplicitEuler", "EulerImplicitSolver"},
    Names{"EulerSolver", "EulerExplicitSolver"},
    Names{"EulerExplicit", "EulerExplicitSolver"},
    Names{"CGSolver", "CGLinearSolver"},
    Names{"ConjugateGradient", "CGLinearSolver"},
    Names{"RungeKutta4", "RungeKutta4Solver"},
    Names{"Mesh", "MeshTopology"},
    Names{"RegularGrid", "RegularGridTopology"},
    Names{"SparseGrid", "SparseGridTopology"},
};

constexpr std::array<std::string_view, 27> ignoredElements = {"VisualStyle",
                                                              "DefaultVisualManagerLoop",
                                                              "BackgroundSetting",
                                                              "Background",
                                                              "ViewerSetting",
                                                              "Viewer",
                                                              "InteractiveCamera",
                                                              "OglSceneFrame",
                                                              "VisualGrid",
                                                              "LineAxis",
                                                              "LightManager",
                                                              "DirectionalLight",
                                                              "SpotLight",
                                                              "PositionalLight",
                                                              "DefaultCollisionGroupManager",
                                                              "CollisionGroupManager",
                                                              "TetrahedronSetGeometryAlgorithms",
                                                              "TriangleSetGeometryAlgorithms",
                                                              "EdgeSetGeometryAlgorithms",
                                                              "PointSetGeometryAlgorithms",
                                                              "QuadSetGeometryAlgorithms",
                                                              "HexahedronSetGeometryAlgorithms",
                                                              "UncoupledConstraintCorrection",
                                                              "LinearSolverConstraintCorrection",
                                                              "MouseConfiguration",
                                                              "AddFrameButtonSetting",
                                                              "SofaDefaultPathSetting"};

constexpr std::array<std::string_view, 16> ignoredNodeAttributes = {"tags",
                                                                    "printLog",
                                                                    "listening",
                                                                    "sleeping",
                                                                    "canChangeSleepingState",
                                                                    "showBoundingTree",
                                                                    "showBehaviorModels",
                                                                    "showVisualModels",
                                                                    "showCollisionModels",
                                                                    "showBoundingCollisionModels",
                                                                    "showMappings",
                                                                    "showMechanicalMappings",
                                                                    "showForceFields",
                                                                    "showInteractionForceFields",
                                                                    "showWireFrame",
                                                                    "showNormals"};

// of any component
constexpr std::array<std::string_view, 8> ignoredAttributes = {
    "listening",       "tags",        "drawSize",  "showObject",
    "showObjectScale", "showIndices", "showColor", "drawMode"};

// of one component
constexpr std::array ofComponent = {
    Names{"DefaultAnimationLoop", "parallelODESolving"},
    Names{"DefaultAnimationLoop", "computeBoundingBox"},
    Names{"EulerImplicitSolver", "threadSafeVisitor"},
    Names{"EulerImplicitSolver", "solveConstraint"},
    Names{"EulerImplicitSolver", "computeResidual"},
    Names{"BoxROI", "drawBoxes"},
    Names{"BoxROI", "drawROI"},
    Names{"BoxROI", "computeEdges"},
    Names{"BoxROI", "computeTriangles"},
    Names{"BoxROI", "computeTetrahedra"},
    Names{"BoxROI", "computeHexahedra"},
    Names{"BoxROI", "computeQuads"},
    Names{"BoxROI", "doUpdate"},
    Names{"SphereROI", "drawSphere"},
    Names{"UniformMass", "showAxisSizeFactor"},
    Names{"ConstantForceField", "showArrowSize"},
    Names{"RestShapeSpringsForceField", "drawSpring"},
    Names{"RegularGridTopology", "computeHexaList"},
    Names{"RegularGridTopology", "computeQuadList"},
    Names{"RegularGridTopology", "computeEdgeList"},
    Names{"RegularGridTopology", "computePointList"},
    Names{"TetrahedronFEMForceField", "computeGlobalMatrix"},
    Names{"TetrahedronFEMForceField", "assembling"},
    Names{"TetrahedronFEMForceField", "updateStiffnessMatrix"},
    Names{"TetrahedronFEMForceField", "updateStiffness"},
    Names{"TetrahedronFEMForceField", "showVonMisesStressPerNode"},
    Names{"TetrahedronFEMForceField", "gatherPt"},
    Names{"TetrahedronFEMForceField", "gatherBsize"},
    Names{"TetrahedronFEMForceField", "drawHeterogeneousTetra"},
    Names{"HexahedronFEMForceField", "updateStiffnessMatrix"},
    Names{"MeshSpringForceField", "drawMinElongationRange"},
    Names{"MeshSpringForceField", "drawMaxElongationRange"},
    Names{"MeshSpringForceField", "drawSpringSize"},
};

bool contains(std::span<const std::string_view> list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

}  // namespace

std::string_view currentName(std::string_view component) {
  for (const auto& [old, current] : renames) {
    if (old == component) return current;
  }
  return component;
}

bool isIgnoredElement(std::string_view component) { return contains(ignoredElements, component); }

bool isIgnoredNodeAttribute(std::string_view name) {
  return name == "depend" || name == "multiThreadSimulation" ||
         contains(ignoredNodeAttributes, name);
}

bool isIgnoredAttribute(std::string_view component, std::string_view name) {
  return contains(ignoredAttributes, name) ||
         std::ranges::find(ofComponent, Names{component, name}) != ofComponent.end();
}

}  // namespace stroma::sofa
