// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "components/cutting/blade_track.h"
#include "components/cutting/cut_facets.h"
#include "components/cutting/cut_history.h"
#include "components/cutting/cut_invariants.h"
#include "components/cutting/cutter.h"
#include "components/cutting/energy_debt.h"
#include "components/cutting/incision_trace.h"
#include "components/cutting/pierce_law.h"
#include "core/attribute.h"
#include "core/interfaces/topology_modifier.h"
#include "core/link.h"
#include "core/schedule.h"

namespace stroma {

// Cuts a body along the edges of tools.
//
// In each step the edge of a tool is drawn back to the rest configuration; what it sweeps there
// divides the surface and blocks the links between particles. With a `solid` (tetrahedra inside
// exactly the surface that `topology` has) the incision gets walls, and pieces come apart as closed
// bodies; without, the surface is cut as an open sheet and the links beneath it as deep as the edge
// reaches.
//
// A blade that presses the surface pierces it when `pierceCriterion` says so; from then on it
// touches nothing (Tool::cutting) and cuts until its edge is outside. With criterion "none" it cuts
// wherever it is. The cut follows the blade in strips of half the mesh's edge length and is brought
// up to the blade when it leaves. One tool cuts at a time; another that wants to is counted.
//
// A blade that cuts one way (Tool::cuttingDirection) does not cut as it draws back, and one that
// goes through a slit which is there already cuts nothing.
//
// Cutting takes no force of its own: see CuttingResistance.
class CuttingTopologyModifier final : public TopologyModifier {
 public:
  Attribute<PierceCriterion> pierceCriterion{
      this, "pierceCriterion", PierceCriterion::none,
      "When a pressing blade goes in: at a von Mises stress of the tissue at its point (as in the "
      "cornea paper), at a force, at a work per area that it would cut, or at once. All but the "
      "last need a contact response to the tool."};
  Attribute<double> pierceStress{this,
                                 "pierceStress",
                                 0.0,
                                 "Stress at which the surface is pierced (pierceCriterion=stress).",
                                 {.unit = "Pa", .min = 0, .runtime = true}};
  Attribute<double> pierceForce{this,
                                "pierceForce",
                                0.0,
                                "Force at which the surface is pierced (pierceCriterion=force).",
                                {.unit = "N", .min = 0, .runtime = true}};
  Attribute<double> pierceEnergy{
      this,
      "pierceEnergy",
      0.0,
      "Work per area at which the surface is pierced (pierceCriterion=energy).",
      {.unit = "J/m^2", .min = 0, .runtime = true}};
  Attribute<bool> needsTrigger{this, "needsTrigger", false,
                               "Blades cut only while the trigger of their device is held."};
  Attribute<bool> subdivide{
      this, "subdivide", true,
      "Splits the elements along the blade's path; false only parts those that are there, which "
      "leaves a jagged incision."};
  Attribute<int> bladePoints{this,
                             "bladePoints",
                             12,
                             "Points of an edge that are drawn back to the rest configuration.",
                             {.min = 2, .max = 1000}};
  Attribute<int> checkEvery{
      this,
      "checkEvery",
      0,
      "Checks what must hold of a cut body after every so many changes (slow), and at the end of "
      "the run; 0 = at the end only.",
      {.min = 0}};
  Attribute<bool> cutting{this, "cutting", false, "A blade is inside.", {.output = true}};
  Attribute<int> changes{this, "changes", 0, "Topology changes so far.", {.output = true}};
  Attribute<double> addedEnergy{
      this,
      "addedEnergy",
      0.0,
      "Energy that the changes of links have added so far, taken away if negative.",
      {.unit = "J", .output = true}};
  Attribute<double> takenEnergy{
      this,
      "takenEnergy",
      0.0,
      "Energy taken from the motion beside the cut, for changes of links that had added some.",
      {.unit = "J", .output = true}};
  Attribute<double> tipStress{
      this,
      "tipStress",
      0.0,
      "Von Mises stress of the tissue where a blade presses hardest, before "
      "it goes in (pierceCriterion=stress).",
      {.unit = "Pa", .output = true}};
  Attribute<double> engagedLength{this,
                                  "engagedLength",
                                  0.0,
                                  "Length of the edge that is inside, at rest.",
                                  {.unit = "m", .output = true}};
  LinkList<Tool> tools{this, "tools", "Blades.", Lookup::explicitOnly, {.aliases = "tool"}};
  Link<Mesh> solid{this,
                   "solid",
                   "Tetrahedra that fill the surface; its nodes are the first points.",
                   Lookup::explicitOnly,
                   {.required = false}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles of the body.", Lookup::nearest, {.aliases = "mstate"}};
  Link<MechanicalState> surfaceState{this, "surfaceState", "Nodes of the surface, mapped.",
                                     Lookup::explicitOnly};
  Link<Topology> topology{this, "topology", "Triangles of the surface.", Lookup::explicitOnly};
  Link<StressField> forceField{this,
                               "forceField",
                               "Whose stress pierces (pierceCriterion=stress).",
                               Lookup::nearest,
                               {.required = false}};

  void configure() override;
  void bind() override;
  void start() override;
  void reset() override;
  void schedule(Schedule& schedule) override;
  void topologyRestored() override;
  [[nodiscard]] TopologyCheck check() const override;
  void replay(StateReader& reader) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] MechanicalState& particles() const override { return *mechanicalState; }
  [[nodiscard]] MechanicalState& nodes() const override { return *surfaceState; }
  [[nodiscard]] Topology& surface() const override { return *topology; }
  // pieces, incision_length and path_length (m), incision_turning (rad) and incision_deviation (in
  // edge lengths), invariant_failures, free_chips, smallest_angle (degrees), sliver_fraction.
  [[nodiscard]] std::vector<std::pair<std::string, double>> lastValues() const override;

  // The blade that is inside now, as pieces of its edge.
  struct BladePiece {
    double length;  // at rest [m]
    Vec3 rest;      // its middle at rest
    Vec3 now;       // and in the scene
    Vec3 along;     // unit tangent of the edge in the scene
  };
  struct Blade {
    Tool* tool = nullptr;   // none if null
    bool advances = false;  // it cuts, and does not go back or through a slit
    std::vector<BladePiece> pieces;
  };
  [[nodiscard]] const Blade& blade() const { return blade_; }
  [[nodiscard]] const RestPlacement& placement() const { return *placement_; }
  [[nodiscard]] const SimplicialComplex& complex() const { return *complex_; }
  [[nodiscard]] const CutFacets& facets() const { return *facets_; }

 private:
  struct Track : BladeTrack {
    using BladeTrack::BladeTrack;
    Pressing pressing;
  };
  void buildComplex();
  void clear();
  void cut(const StepContext& step);
  [[nodiscard]] bool pierces(const Tool& tool, const Track& track);
  // Whether the blade that cuts goes on to do so.
  [[nodiscard]] bool staysIn(const Track& track, bool near, const BladeCourse::Course& course);
  void advance(Tool& tool, const Track& track, const BladeCourse::Course& course);
  [[nodiscard]] bool goesForward(const Tool& tool) const;
  [[nodiscard]] bool inOldSlit() const;
  void endCut(ConstVec3Span edge);
  void sweep(std::vector<Vec3> part, double length);
  void showBlade(Tool& tool, const Track& track, const BladeCourse::Course& course);
  [[nodiscard]] bool wasSet(const Tool& tool, const Track& track) const;
  void leave(bool moved);
  [[nodiscard]] TopologyCheck check(const SurfaceNumbers& surface) const;
  void change(const SurfaceEdit& edit, LinkEnergy* energy);
  void apply(const SurfaceEdit& edit);

  std::unique_ptr<SimplicialComplex> complex_;
  std::unique_ptr<Cutter> cutter_;
  std::unique_ptr<CutFacets> facets_;
  std::unique_ptr<RestPlacement> placement_;
  std::unique_ptr<BladeCourse> course_;
  double volume_ = 0;          // of the solid at rest [m^3]
  double meanEdge_ = 0;        // of the uncut mesh [m]
  std::vector<Track> tracks_;  // one a tool
  Index active_ = -1;          // the tool that cuts
  Blade blade_;
  CutHistory history_;
  double wayOut_ = 0;               // of the blade that cuts, since it was last inside [m]
  BladeCourse::Extent lastExtent_;  // of the blade that cuts
  IncisionTrace trace_{0};
  EnergyDebt debt_;
  int failures_ = 0;  // found by the checks on the way
  Limiter busy_{this, "busy", "steps in which a second blade wanted to cut and could not"};
  Limiter untouched_{this, "untouched",
                     "steps in which an edge was inside without having pressed: the criterion of "
                     "piercing needs a contact response to the tool"};
  Limiter lost_{this, "lost",
                "steps in which the edge of a cutting blade was nowhere near a particle"};
};

}  // namespace stroma
