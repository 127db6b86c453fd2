// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/particle_sampler.h"

#include <algorithm>

#include "components/sampling/lattice.h"
#include "components/sampling/shell_sampler.h"
#include "components/sampling/surface_check.h"
#include "components/sampling/volume_sampler.h"

namespace stroma {
namespace {

SurfaceMesh copyOf(const Mesh& mesh) {
  return {{mesh.positions().begin(), mesh.positions().end()},
          {mesh.triangles().begin(), mesh.triangles().end()}};
}

}  // namespace

void ParticleSampler::bind() {
  if (layout == ParticleLayout::lattice) return fillLattice();
  if (!surface) {
    error("sampler-surface", "has no surface to fill", "give surface=\"@loader\"");
    return;
  }
  if (!count.isSet()) {
    error("sampler-count", "needs 'count', the number of particles");
    return;
  }
  closed_ = copyOf(*surface);
  if (const std::string problem = whyNotSheet(closed_.positions, closed_.triangles);
      !problem.empty()) {
    const auto isTurned = [](const SurfaceFinding& f) {
      return f.fault == SurfaceFault::insideOut;
    };
    const bool turned =
        std::ranges::any_of(checkSurface(closed_.positions, closed_.triangles), isTurned);
    error("sampler-surface", "cannot fill '" + surface->path() + "': " + problem,
          turned ? "flipNormals=\"true\" on its loader turns the triangles over" : "");
    return;
  }
  if (layout == ParticleLayout::shell)
    fillShell();
  else
    fillVolume();
}

void ParticleSampler::fillVolume() {
  if (!boundaryLoops(closed_.triangles).empty())
    closed_ = thickness.isSet()
                  ? closeSheets(thickenSheet(closed_.positions, closed_.triangles, thickness))
                  : capRims(closed_.positions, closed_.triangles);
  VolumeSamplerOptions options;
  options.count = count;
  options.seed = static_cast<std::uint64_t>(*seed);
  options.relaxations = relaxations;
  VolumeSamples samples = sampleVolume(closed_.positions, closed_.triangles, options);
  if (!samples.problem.empty()) {
    error("sampler-volume", "cannot fill '" + surface->path() + "': " + samples.problem);
    return;
  }
  position.set(std::move(samples.positions));
  volume.set(std::move(samples.volumes));
  spacing.set(samples.spacing);
}

void ParticleSampler::fillShell() {
  const bool open = !boundaryLoops(closed_.triangles).empty();
  if (open && !thickness.isSet()) {
    error("sampler-open", "cannot fill '" + surface->path() + "': the surface is open",
          "give this sampler a 'thickness', or use a closed shell");
    return;
  }
  ShellSamplerOptions options;
  options.count = count;
  options.layers = layers;
  options.seed = static_cast<std::uint64_t>(*seed);
  options.relaxations = relaxations;
  ShellSamples samples;
  if (open) {
    const ShellSheets sheets = thickenSheet(closed_.positions, closed_.triangles, thickness);
    closed_ = closeSheets(sheets);
    samples = sampleShell(sheets, enclosedVolume(closed_.positions, closed_.triangles), options);
  } else {
    samples = sampleShell(closed_.positions, closed_.triangles, options);
  }
  if (!samples.problem.empty()) {
    error("sampler-shell", "cannot fill '" + surface->path() + "': " + samples.problem);
    return;
  }
  position.set(std::move(samples.positions));
  volume.set(std::move(samples.volumes));
  normal.set(std::move(samples.normals));
  spacing.set(samples.tangentialSpacing);
  layerSpacing.set(samples.layerSpacing);
  rimIndices.set({std::move(samples.rim)});
}

void ParticleSampler::fillLattice() {
  LatticeOptions options;
  options.cells = n;
  options.min = min;
  options.max = max;
  options.jitter = jitter;
  options.seed = static_cast<std::uint64_t>(*seed);
  LatticeSamples samples = sampleLattice(options);
  if (!samples.problem.empty()) {
    error("sampler-lattice", samples.problem);
    return;
  }
  position.set(std::move(samples.positions));
  volume.set(std::move(samples.volumes));
  spacing.set(samples.spacing);
  closed_ = std::move(samples.surface);
}

}  // namespace stroma
