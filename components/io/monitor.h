// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>

#include "components/io/recorder.h"
#include "core/interfaces/mechanical_state.h"
#include "core/topology_change.h"

namespace stroma {

enum class Quantity {
  displacement,
  position,
  velocity,
  force,
  reaction,
  kineticEnergy,
  potentialEnergy
};
enum class Part { x, y, z, norm, vector };
enum class Reduction { mean, sum, max, each };

template <>
struct EnumNames<Quantity> {
  static constexpr std::array<std::pair<Quantity, std::string_view>, 7> names{
      {{Quantity::displacement, "displacement"},
       {Quantity::position, "position"},
       {Quantity::velocity, "velocity"},
       {Quantity::force, "force"},
       {Quantity::reaction, "reaction"},
       {Quantity::kineticEnergy, "kineticEnergy"},
       {Quantity::potentialEnergy, "potentialEnergy"}}};
};
template <>
struct EnumNames<Part> {
  static constexpr std::array<std::pair<Part, std::string_view>, 5> names{
      {{Part::x, "x"},
       {Part::y, "y"},
       {Part::z, "z"},
       {Part::norm, "norm"},
       {Part::vector, "vector"}}};
};
template <>
struct EnumNames<Reduction> {
  static constexpr std::array<std::pair<Reduction, std::string_view>, 4> names{
      {{Reduction::mean, "mean"},
       {Reduction::sum, "sum"},
       {Reduction::max, "max"},
       {Reduction::each, "each"}}};
};

// Records one value, named like the component, as a table (step, time, value) in <name>.csv: a
// quantity of chosen particles, or any numeric attribute of a component. Every row is on disk when
// its step ends.
//
// Displacements (m) count from the rest positions. The reaction (N) is minus the force left on the
// particles, which on held ones is what their support takes. Energies (J) are those of everything
// that the state's solver governs. Vectors are first added up or averaged, then measured: norm with
// mean is the length of the mean vector; max is the largest measure (by absolute value) that any
// particle has; each gives every particle its own column.
//
// When the body is cut whose surface the state holds, copies of the chosen nodes and nodes on edges
// between them join, and all new ones where all are recorded; with `each` the columns stay.
class Monitor final : public Recorder {
 public:
  Monitor() : Recorder(1, true) {}

  Attribute<Quantity> quantity{this, "quantity", Quantity::displacement, "What is recorded."};
  Attribute<Part> component{this, "component", Part::norm, "Which part of vectors."};
  Attribute<Reduction> reduce{this, "reduce", Reduction::mean, "How particles become one value."};
  Attribute<IndexList> indices{this, "indices", {}, "Particles, all if not given."};
  Attribute<double> since{this,
                          "since",
                          0.0,
                          "Displacements count from where the particles are at this time, and are "
                          "zero before; not given = from the rest positions.",
                          {.unit = "s", .min = 0}};
  Attribute<std::string> attribute{
      this, "attribute", "", "Records this numeric attribute instead: \"@component.attribute\"."};
  Link<MechanicalState> mechanicalState{
      this, "state", "Whose particles.", Lookup::nearest, {.required = false, .aliases = "mstate"}};

  void configure() override;
  void bind() override;
  void start() override;
  void schedule(Schedule& schedule) override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void reset() override;
  void stop() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> lastValues() const override;

 protected:
  void record(double time, std::uint64_t step) override;

 private:
  struct Samples {
    int components;  // of each sample, 1 or 3
    std::vector<double> values;
  };
  [[nodiscard]] Samples sample() const;
  [[nodiscard]] Samples sampleAttribute() const;
  [[nodiscard]] Samples sampleEnergy() const;
  [[nodiscard]] std::string unit() const;
  void takeReference(const StepContext& step);
  void followReference(const TopologyChange& change, std::size_t firstNew);
  [[nodiscard]] Vec3 displacementOf(std::size_t k) const;
  // File with its header and, after a resumption, the rows up to then.
  void open();

  std::vector<Index> particles_;
  std::size_t chosen_ = 0;       // number of particles before any cut
  std::vector<Vec3> reference_;  // positions at `since`, empty before
  std::ofstream out_;
  std::optional<std::uint64_t> resumedAt_;
  bool started_ = false;
};

}  // namespace stroma
