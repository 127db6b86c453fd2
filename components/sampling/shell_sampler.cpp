// SPDX-License-Identifier: Apache-2.0
#include "components/sampling/shell_sampler.h"

#include <algorithm>
#include <cmath>

#include "components/sampling/blue_noise.h"
#include "components/sampling/point_grid.h"
#include "components/sampling/surface_check.h"
#include "core/parallel.h"
#include "core/random.h"

namespace stroma {
namespace {

constexpr int candidatesPerColumn = 4;
constexpr double overRelaxation = 1.8;  // halves the number of Lloyd steps; the last one is plain

// Prism volume up to depth z in [0, 1] from the outer sheet: a z + b z^2 / 2 + c z^3 / 3.
struct DepthVolume {
  double a = 0, b = 0, c = 0;

  [[nodiscard]] double upTo(double z) const { return z * (a + z * (b / 2 + z * c / 3)); }
  // Integral of depth over volume up to z.
  [[nodiscard]] double momentUpTo(double z) const {
    return z * z * (a / 2 + z * (b / 3 + z * c / 4));
  }
  // The same of depth squared.
  [[nodiscard]] double secondMomentUpTo(double z) const {
    return z * z * z * (a / 3 + z * (b / 4 + z * c / 5));
  }
  DepthVolume& operator+=(const DepthVolume& other) {
    a += other.a;
    b += other.b;
    c += other.c;
    return *this;
  }
};

// A small ruled prism between the sheets.
struct Prism {
  Vec3 outer, inner;  // middles of its ends
  DepthVolume volume;
  bool atRim;
};

using Corners = std::array<Vec3, 3>;

// Exact for ends that are triangles and sides that are ruled: the cross-section at depth z is
// spanned by edges linear in z, its vector area is quadratic.
Prism makePrism(const Corners& outer, const Corners& inner, bool atRim) {
  const Vec3 u = outer[1] - outer[0], v = outer[2] - outer[0];
  const Vec3 du = inner[1] - inner[0] - u, dv = inner[2] - inner[0] - v;
  Prism prism{
      (outer[0] + outer[1] + outer[2]) / 3, (inner[0] + inner[1] + inner[2]) / 3, {}, atRim};
  const Vec3 halfDown = 0.5 * (prism.outer - prism.inner);
  prism.volume = {u.cross(v).dot(halfDown), (u.cross(dv) + du.cross(v)).dot(halfDown),
                  du.cross(dv).dot(halfDown)};
  return prism;
}

std::vector<Vec3> middles(const ShellSheets& s) {
  std::vector<Vec3> mid(s.outer.size());
  for (std::size_t i = 0; i < mid.size(); ++i) mid[i] = 0.5 * (s.outer[i] + s.inner[i]);
  return mid;
}

// The points (i, j), i + j <= m, of a triangle divided m times along each side, row by row.
int latticeIndex(int m, int i, int j) { return i * (m + 1) - i * (i - 1) / 2 + j; }

void fillLattice(const std::vector<Vec3>& x, const Triangle& t, int m, std::vector<Vec3>& lattice) {
  lattice.clear();
  const Vec3 u = (x[t[1]] - x[t[0]]) / m, v = (x[t[2]] - x[t[0]]) / m;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; i + j <= m; ++j) lattice.emplace_back(x[t[0]] + i * u + j * v);
}

// Splits each pair of facing triangles into m x m prisms of at most `area` on the mid-surface.
std::vector<Prism> prismsOf(const ShellSheets& s, ConstVec3Span mid, double area,
                            const std::vector<Edge>& rim) {
  std::vector<Prism> prisms;
  std::vector<Vec3> outer, inner;
  for (const Triangle& t : s.triangles) {
    const auto isOpen = [&](int k, int l) {
      return std::binary_search(rim.begin(), rim.end(), Edge{t[k], t[l]});
    };
    const bool open01 = isOpen(0, 1), open12 = isOpen(1, 2), open20 = isOpen(2, 0);
    const int m =
        std::max(1, static_cast<int>(std::ceil(std::sqrt(vectorArea(mid, t).norm() / area))));
    fillLattice(s.outer, t, m, outer);
    fillLattice(s.inner, t, m, inner);
    const auto add = [&](int a, int b, int c, bool atRim) {
      prisms.push_back(
          makePrism({outer[a], outer[b], outer[c]}, {inner[a], inner[b], inner[c]}, atRim));
    };
    for (int i = 0; i < m; ++i)
      for (int j = 0; i + j < m; ++j) {
        const int a = latticeIndex(m, i, j), b = latticeIndex(m, i + 1, j);
        add(a, b, a + 1, (open01 && j == 0) || (open12 && i + j + 1 == m) || (open20 && i == 0));
        if (i + j + 1 < m) add(b, b + 1, a + 1, false);
      }
  }
  return prisms;
}

std::vector<Edge> rimEdgesOf(const ShellSheets& s) {
  std::vector<Edge> rim;
  for (const std::vector<Index>& loop : boundaryLoops(s.triangles))
    for (std::size_t k = 0; k < loop.size(); ++k)
      rim.push_back({loop[k], loop[(k + 1) % loop.size()]});
  std::sort(rim.begin(), rim.end());
  return rim;
}

// Random points of the mid-surface, spread over the prisms in proportion to their volume.
std::vector<Vec3> candidates(const std::vector<Prism>& prisms, double size, Index count,
                             std::uint64_t seed) {
  double total = 0;
  for (const Prism& p : prisms) total += p.volume.upTo(1);
  UniformRandom random(seed);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(count));
  std::size_t s = 0;
  double passed = 0;
  for (Index c = 0; c < count; ++c) {
    const double target = (c + random()) * total / count;
    while (s + 1 < prisms.size() && passed + prisms[s].volume.upTo(1) <= target)
      passed += prisms[s++].volume.upTo(1);
    // off the prism's middle, so that no two candidates coincide
    Vec3 jitter;
    for (int d = 0; d < 3; ++d) jitter[d] = random() - 0.5;
    points.push_back(0.5 * (prisms[s].outer + prisms[s].inner) + 0.5 * size * jitter);
  }
  return points;
}

// The columns' cells, summed over their prisms.
struct Column {
  Vec3 outer = Vec3::Zero(), inner = Vec3::Zero();
  DepthVolume volume;
  bool atRim = false;
};

std::vector<Column> partition(const std::vector<Prism>& prisms, const std::vector<Vec3>& seeds,
                              double spacing) {
  const PointGrid grid(seeds, spacing);
  std::vector<Index> owner(prisms.size());
  parallelChunks(static_cast<Index>(owner.size()), 1024, [&](Index begin, Index end) {
    Index guess = -1;
    for (Index s = begin; s < end; ++s)
      owner[s] = guess = grid.nearest(0.5 * (prisms[s].outer + prisms[s].inner), guess);
  });
  std::vector<Column> columns(seeds.size());
  for (std::size_t s = 0; s < prisms.size(); ++s) {
    Column& column = columns[owner[s]];
    const double weight = prisms[s].volume.upTo(1);
    column.outer += weight * prisms[s].outer;
    column.inner += weight * prisms[s].inner;
    column.volume += prisms[s].volume;
    column.atRim = column.atRim || prisms[s].atRim;
  }
  for (Column& column : columns)
    if (const double weight = column.volume.upTo(1); weight > 0) {
      column.outer /= weight;
      column.inner /= weight;
    }
  return columns;
}

void relax(const std::vector<Prism>& prisms, double spacing, int steps, std::vector<Vec3>& seeds) {
  for (int step = 1; step <= steps; ++step) {
    const std::vector<Column> columns = partition(prisms, seeds, spacing);
    const double reach = step < steps ? overRelaxation : 1;
    for (std::size_t c = 0; c < seeds.size(); ++c)
      if (columns[c].volume.upTo(1) > 0)
        seeds[c] += reach * (0.5 * (columns[c].outer + columns[c].inner) - seeds[c]);
  }
}

// Cuts a column into layers of equal thickness, a particle for each. The particles lie at the
// layers' middles (of volume), spread about the column's own until their second moment is the
// column's: n points in the middles of n layers have 1 - 1/n^2 of it, and the shell would bend that
// much too easily. A single layer has nothing to spread.
void stack(const Column& column, Index layers, double scale, ShellSamples& out) {
  const Vec3 down = column.inner - column.outer;
  const double whole = column.volume.upTo(1), centre = column.volume.momentUpTo(1) / whole;
  const auto first = out.positions.size();
  std::vector<double> depth;
  double ofPoints = 0;
  for (Index k = 0; k < layers; ++k) {
    const double from = static_cast<double>(k) / layers, to = static_cast<double>(k + 1) / layers;
    const double volume = column.volume.upTo(to) - column.volume.upTo(from);
    const double moment = column.volume.momentUpTo(to) - column.volume.momentUpTo(from);
    depth.push_back(moment / volume - centre);
    ofPoints += volume * depth.back() * depth.back();
    if (column.atRim) out.rim.push_back(static_cast<Index>(first) + k);
    out.volumes.push_back(volume * scale);
    out.normals.push_back(-down.normalized());
    out.thicknesses.push_back(down.norm() / layers);
  }
  const double ofColumn = column.volume.secondMomentUpTo(1) - whole * centre * centre;
  const double spread = layers > 1 ? std::sqrt(ofColumn / ofPoints) : 1;
  for (const double d : depth) out.positions.push_back(column.outer + (centre + spread * d) * down);
}

std::string whyNotPossible(const ShellSheets& s, double volume, const ShellSamplerOptions& o) {
  if (o.layers < 1 || o.count < 1) return "the numbers of particles and layers must be at least 1";
  if (o.count < o.layers)
    return std::to_string(o.count) + " particles cannot be stacked in " + std::to_string(o.layers) +
           " layers";
  if (o.count % o.layers != 0)
    return std::to_string(o.count) + " particles cannot be stacked in columns of " +
           std::to_string(o.layers) + "; " + std::to_string(o.count - o.count % o.layers) + " or " +
           std::to_string(o.count - o.count % o.layers + o.layers) + " can";
  if (o.relaxations < 0 || o.samplesPerColumn < 8 || o.samplesPerColumn > 4096)
    return "relaxations must not be negative, samples a column must be from 8 to 4096";
  if (s.inner.size() != s.outer.size()) return "the two sheets have different numbers of nodes";
  if (!(volume > 0)) return "the shell encloses no volume";
  return whyNotSheet(s.outer, s.triangles);
}

}  // namespace

ShellSamples sampleShell(ConstVec3Span x, TriangleSpan triangles,
                         const ShellSamplerOptions& options) {
  const FoundSheets found = findSheets(x, triangles);
  if (found.problem.empty()) return sampleShell(found.sheets, found.volume, options);
  ShellSamples out;
  out.problem = found.problem;
  return out;
}

ShellSamples sampleShell(const ShellSheets& sheets, double volume,
                         const ShellSamplerOptions& options) {
  ShellSamples out;
  out.problem = whyNotPossible(sheets, volume, options);
  if (!out.problem.empty()) return out;
  out.columns = options.count / options.layers;
  const std::vector<Vec3> mid = middles(sheets);
  const std::vector<Edge> rim = rimEdgesOf(sheets);
  const double area = surfaceArea(mid, sheets.triangles);
  out.tangentialSpacing = std::sqrt(area / out.columns);
  out.layerSpacing = volume / area / options.layers;

  // blue noise on the mid-surface, then Lloyd
  const double sampleArea = area / out.columns / options.samplesPerColumn;
  std::vector<Vec3> seeds;
  {
    const std::vector<Prism> prisms = prismsOf(sheets, mid, sampleArea, rim);
    const std::vector<Vec3> points =
        candidates(prisms, std::sqrt(sampleArea), candidatesPerColumn * out.columns, options.seed);
    const double closest = std::sqrt(area / (2 * std::sqrt(3.0) * out.columns));
    for (const Index i : eliminateSamples(points, out.columns, closest)) seeds.push_back(points[i]);
    relax(prisms, out.tangentialSpacing, options.relaxations, seeds);
  }

  // final cells
  const std::vector<Column> columns =
      partition(prismsOf(sheets, mid, sampleArea / 4, rim), seeds, out.tangentialSpacing);
  double total = 0;
  for (const Column& column : columns) {
    total += column.volume.upTo(1);
    double thinnest = column.volume.upTo(1);
    for (Index k = 0; k < options.layers; ++k)
      thinnest =
          std::min(thinnest, column.volume.upTo(static_cast<double>(k + 1) / options.layers) -
                                 column.volume.upTo(static_cast<double>(k) / options.layers));
    if (!(thinnest > 0)) {
      out.problem = "a column of particles got no volume: the sheets touch or cross each other";
      return out;
    }
  }
  for (const Column& column : columns) stack(column, options.layers, volume / total, out);
  return out;
}

}  // namespace stroma
