// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/sampling/surface_mesh.h"
#include "core/interfaces/mesh.h"

namespace stroma {

enum class ParticleLayout { volume, shell, lattice };

template <>
struct EnumNames<ParticleLayout> {
  static constexpr std::array<std::pair<ParticleLayout, std::string_view>, 3> names = {
      {{ParticleLayout::volume, "volume"},
       {ParticleLayout::shell, "shell"},
       {ParticleLayout::lattice, "lattice"}}};
};

// The particles of a body, with the volumes they stand for, which partition the body's volume.
// `volume` fills a closed surface with blue noise relaxed to cell centroids, `shell` a thin one
// with stacked columns, `lattice` a box with a regular lattice. Open surfaces are closed for
// sampling: given a `thickness` (inwards from the surface), or else, by `volume`, lids on their
// rims.
class ParticleSampler final : public Topology {
 public:
  Attribute<ParticleLayout> layout{
      this, "layout", ParticleLayout::volume,
      "How particles are laid: volume (blue noise), shell (stacked columns), lattice (a box)."};
  Attribute<int> count{this,
                       "count",
                       0,
                       "Particles wanted (volume, shell).",
                       {.min = 1, .max = 20'000'000, .aliases = "particles"}};
  Attribute<int> layers{
      this, "layers", 3, "Particles through the thickness (shell).", {.min = 1, .max = 1000}};
  Attribute<double> thickness{this,
                              "thickness",
                              0.0,
                              "Gives an open surface this thickness, inwards (volume, shell).",
                              {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<std::array<Index, 3>> n{this, "n", {1, 1, 1}, "Particles along x, y and z (lattice)."};
  Attribute<Vec3> min{
      this, "min", Vec3::Zero(), "Lower corner of the box (lattice).", {.unit = "m"}};
  Attribute<Vec3> max{
      this, "max", Vec3::Ones(), "Upper corner of the box (lattice).", {.unit = "m"}};
  Attribute<double> jitter{this,
                           "jitter",
                           0.0,
                           "Moves every coordinate by up to this share of the cell (lattice).",
                           {.min = 0, .max = 0.5, .exclusiveMax = true}};
  Attribute<int> seed{
      this, "seed", 1, "Other seeds give other clouds, the same seed the same bits.", {.min = 0}};
  Attribute<int> relaxations{
      this, "relaxations", 10, "Lloyd steps towards cell centroids.", {.min = 0, .max = 1000}};
  Link<Mesh> surface{this,
                     "surface",
                     "The surface to fill (volume, shell).",
                     Lookup::sameNode,
                     {.required = false, .aliases = "mesh"}};

  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Particles.", {.unit = "m", .output = true, .autolink = true}};
  Attribute<std::vector<double>> volume{this,
                                        "volume",
                                        {},
                                        "Volume that each particle stands for.",
                                        {.unit = "m^3", .output = true, .autolink = true}};
  Attribute<std::vector<Vec3>> normal{this,
                                      "normal",
                                      {},
                                      "Unit direction of each particle's column, outwards (shell).",
                                      {.output = true, .autolink = true}};
  Attribute<double> spacing{this,
                            "spacing",
                            0.0,
                            "Distance of neighbours; along the layers of a shell.",
                            {.unit = "m", .output = true, .autolink = true}};
  Attribute<double> layerSpacing{this,
                                 "layerSpacing",
                                 0.0,
                                 "Distance of layers (shell).",
                                 {.unit = "m", .output = true, .autolink = true}};
  Attribute<IndexList> rimIndices{this,
                                  "rimIndices",
                                  {},
                                  "Particles of the columns at the open rims (shell).",
                                  {.output = true}};

  void bind() override;
  [[nodiscard]] ConstVec3Span positions() const override { return *position; }
  [[nodiscard]] std::span<const double> volumes() const override { return *volume; }
  [[nodiscard]] SurfaceView enclosingSurface() const override {
    return {closed_.positions, closed_.triangles};
  }

 private:
  void fillVolume();
  void fillShell();
  void fillLattice();

  SurfaceMesh closed_;
};

}  // namespace stroma
