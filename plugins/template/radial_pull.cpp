// SPDX-License-Identifier: Apache-2.0
// A force field of one's own: every particle is pulled to a point by a linear spring.
#include "core/interfaces/force_field.h"
#include "core/parallel.h"
#include "core/plugin.h"

using namespace stroma;

class RadialPull final : public ForceField {
 public:
  Attribute<double> stiffness{this,
                              "stiffness",
                              100.0,
                              "Pull on each particle per distance from the centre.",
                              {.unit = "N/m", .min = 0.0, .runtime = true}};
  Attribute<Vec3> centre{this, "centre", Vec3::Zero(), "Where the pull goes to.", {.unit = "m"}};
  Link<MechanicalState> particles{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  MechanicalState& state() const override { return *particles; }

  // f = -k (x - c)
  void addForce(const StateView& at, Vec3Span f) override {
    const double k = stiffness;  // read once, not for each particle
    const Vec3 c = centre;
    parallelFor(at.size(), [&](Index i) { f[i] -= k * (at.x[i] - c); });
  }

  // E = k |x - c|^2 / 2: the force is minus its gradient
  double potentialEnergy(const StateView& at) const override {
    double sum = 0;
    for (const Vec3& x : at.x) sum += (x - *centre).squaredNorm();
    return 0.5 * stiffness * sum;
  }

  // df/dx = -k at any state: there is nothing to prepare
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double stiffnessFactor, double,
                         Vec3Span df) const override {
    const double k = stiffness * stiffnessFactor;
    parallelFor(static_cast<Index>(dx.size()), [&](Index i) { df[i] -= k * dx[i]; });
  }
};

PLUGIN(radial_pull, "1.0.0", "Apache-2.0", "Radial pull, a template for force fields of your own.")
(Registry& registry) {
  registry.add<RadialPull>("RadialPull")
      .doc("Pulls every particle to a point by a linear spring.")
      .example("plugins/template/radial_pull.xml");
}
