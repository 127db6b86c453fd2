// SPDX-License-Identifier: Apache-2.0
#include "tests/components/cutting/body_cuts.h"

namespace stroma::test {
namespace {

// Boxes apart from each other need no predicate; nothing else is skipped, and no grid is used.
class AllFacets {
 public:
  explicit AllFacets(std::span<const RestTriangle> facets) : facets_(facets) {
    for (const RestTriangle& t : facets)
      boxes_.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])});
  }
  [[nodiscard]] bool between(const Vec3& a, const Vec3& b) const {
    for (const std::size_t k : near(a.cwiseMin(b), a.cwiseMax(b)))
      if (segmentCrossesTriangle(a, b, facets_[k][0], facets_[k][1], facets_[k][2])) return true;
    return false;
  }
  // Those that could lie between one point and any of the others.
  [[nodiscard]] AllFacets around(const Vec3& from, ConstVec3Span to) {
    Vec3 low = from, high = from;
    for (const Vec3& p : to) low = low.cwiseMin(p), high = high.cwiseMax(p);
    kept_.clear();
    for (const std::size_t k : near(low, high)) kept_.push_back(facets_[k]);
    return AllFacets(kept_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> near(const Vec3& low, const Vec3& high) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const auto& [boxLow, boxHigh] = boxes_[k];
      if (high.x() < boxLow.x() || low.x() > boxHigh.x() || high.y() < boxLow.y() ||
          low.y() > boxHigh.y() || high.z() < boxLow.z() || low.z() > boxHigh.z())
        continue;
      found.push_back(k);
    }
    return found;
  }
  std::span<const RestTriangle> facets_;
  std::vector<std::pair<Vec3, Vec3>> boxes_;
  std::vector<RestTriangle> kept_;
};

struct Body {
  Scene scene;
  RandomDivider* divider;
  MLSForceField* field;
  MLSMapping* mapping;

  explicit Body(const std::string& text) : scene(options()) {
    Registry& registry = scene.registry();
    registry.add<MLSForceField>("MLSForceField");
    registry.add<MLSMapping>("MLSMapping");
    registry.add<RandomDivider>("RandomDivider");
    const std::filesystem::path beside = std::filesystem::path(STROMA_SCENES) / "cornea/text.xml";
    if (!scene.loadText(text, beside) || !scene.initialise())
      throw std::runtime_error(scene.diagnostics().text());
    divider = collect<RandomDivider>(scene.root()).front();
    field = collect<MLSForceField>(scene.root()).front();
    mapping = collect<MLSMapping>(scene.root()).front();
  }
  static SceneOptions options() {
    SceneOptions options;
    options.pluginFolders = {STROMA_MODULES_FOLDER};
    options.writesOutput = false;
    return options;
  }
};

// Links of every `every`-th particle, from number `first` on: all can be seen, and all that can be
// seen within the row's reach are there.
void askLinks(const Body& body, AllFacets& all, Index first, Index every, BodyTotals& totals) {
  const ConstVec3Span X = body.field->state().rest();
  const Neighbourhoods& n = body.field->neighbourhoods();
  std::vector<Vec3> ends;
  for (Index i = first; i < n.particleCount(); i += every) {
    const auto row = n.neighboursOf(i);
    totals.few += row.size() < 8;
    double last = n.options.count == 0 ? n.options.radius : 0;
    for (const Index j : row) last = std::max(last, n.distance(i, X[j] - X[i]));
    std::vector<Index> within;
    ends.clear();
    for (Index j = 0; j < n.particleCount(); ++j) {
      const bool own = std::ranges::find(row, j) != row.end();
      if (j == i || (!own && n.distance(i, X[j] - X[i]) >= last)) continue;
      within.push_back(j);
      ends.push_back(X[j]);
    }
    const AllFacets facets = all.around(X[i], ends);
    for (std::size_t k = 0; k < within.size(); ++k) {
      const bool own = std::ranges::find(row, within[k]) != row.end();
      EXPECT_NE(own, facets.between(X[i], ends[k])) << "particles " << i << " and " << within[k];
      EXPECT_EQ(facets.between(X[i], ends[k]), facets.between(ends[k], X[i]));
      ++totals.links;
    }
  }
}

// Carriers of surface nodes, seen from the places just inside.
void askSupports(const Body& body, AllFacets& all, Index first, Index every, BodyTotals& totals) {
  const ConstVec3Span X = body.field->state().rest();
  const RandomDivider& divider = *body.divider;
  const SurfaceShape& shape = body.mapping->shape();
  std::vector<Vec3> ends;
  for (Index s = first; s < shape.pointCount(); s += every) {
    if (divider.retired[static_cast<std::size_t>(s)]) continue;
    const Vec3& eye = divider.eyes[static_cast<std::size_t>(s)];
    const auto carriers = shape.carriersOf(s);
    ends.clear();
    for (const Index i : carriers) ends.push_back(X[i]);
    const AllFacets facets = all.around(eye, ends);
    for (const Vec3& end : ends) {
      // a chip that holds no particle is carried by the nearest one, which it cannot see
      EXPECT_TRUE(carriers.size() == 1 || !facets.between(eye, end)) << "node " << s;
      ++totals.supports;
    }
  }
}

// After a change. False when something is wrong.
bool checkBody(const Body& body, BodyTotals& totals) {
  ++totals.checks;
  const TopologyCheck report = body.divider->check();
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  totals.chips = std::max(totals.chips, static_cast<long>(report.freeChips));
  return report.failures.empty();
}

// The part of a straight blade in the body's box, as whoever moves a blade in a scene gives it to
// the cutter; empty where it is away.
std::vector<Vec3> partOf(const std::vector<Vec3>& whole, const Eigen::AlignedBox3d& box) {
  const Vec3 &from = whole.front(), way = whole.back() - from;
  double first = 0, last = 1;
  for (int d = 0; d < 3; ++d) {
    const double a = (box.min()[d] - from[d]) / way[d], b = (box.max()[d] - from[d]) / way[d];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (!(first < last)) return {};
  return blade(from + first * way, from + last * way);
}

bool cutOnce(Body& body, const RandomCut& cut, int checkEvery, BodyTotals& totals) {
  RandomDivider& divider = *body.divider;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : divider.nodes().rest()) box.extend(p);
  const Vec3 margin = Vec3::Constant(2 * divider.cutter->spacing());
  box.extend(Vec3(box.min() - margin)).extend(Vec3(box.max() + margin));
  for (const Sweep& sweep : cut.sweeps)
    for (int k = 0; k <= cut.steps + 1; ++k) {
      SurfaceEdit edit;
      const std::vector<Vec3> whole = sweep(std::min(1.0, static_cast<double>(k) / cut.steps));
      const std::vector<Vec3> part = partOf(whole, box);
      if (!part.empty() && k <= cut.steps)
        edit = divider.cutter->advance(part, (whole.back() - whole.front()).norm());
      else if (divider.cutter->cutting())
        edit = divider.cutter->finish();
      if (!divider.change(edit)) continue;
      ++totals.changes;
      if (totals.changes % checkEvery == 0 && !checkBody(body, totals)) return false;
    }
  return checkBody(body, totals);
}

}  // namespace

void RandomDivider::topologyRestored() {
  const ConstVec3Span rest = nodes().rest();
  std::vector<Vec3> points(solid->positions().begin(), solid->positions().end());
  std::ranges::copy(rest, points.begin());
  complex = std::make_unique<SimplicialComplex>(
      SimplicialComplex::fromTetrahedra(points, solid->tetrahedra(), surface().triangles()));
  cutter = std::make_unique<Cutter>(*complex);
  facets = std::make_unique<CutFacets>(cutter->spacing());
  eyes.assign(rest.begin(), rest.end());
  retired.assign(rest.size(), 0);
  volume = checkInvariants(*complex).volume;
}

bool RandomDivider::change(const SurfaceEdit& edit) {
  if (edit.empty()) return false;
  facets->add(edit.cutFacets);
  scene().changeTopology({particles(), nodes(), surface(), edit, *facets});
  for (const NewSurfaceNode& node : edit.nodes) eyes.push_back(node.rest);
  retired.resize(eyes.size(), 0);
  for (const TouchedNode& t : edit.touched) eyes[static_cast<std::size_t>(t.node)] = t.inward;
  for (const Index node : edit.retired) retired[static_cast<std::size_t>(node)] = 1;
  return true;
}

TopologyCheck RandomDivider::check() const {
  TopologyCheck report{particles(), nodes(), surface(), *facets, 0, {}};
  report.failures = checkInvariants(*complex, volume).failures;
  if (!std::ranges::equal(surface().triangles(), complex->surface()))
    report.failures.emplace_back("the surface has other triangles than were cut");
  if (!std::ranges::equal(nodes().rest(), complex->nodePositions()))
    report.failures.emplace_back("the nodes are not where the surface was cut");
  scene().checkTopology(report);
  return report;
}

BodyTotals cutBodies(const std::string& sceneText, unsigned first, unsigned count,
                     const BodyEffort& effort) {
  const auto begin = std::chrono::steady_clock::now();
  Body body(sceneText);
  RandomDivider& divider = *body.divider;
  const std::vector<double> mass(body.scene.systems().front()->mass().begin(),
                                 body.scene.systems().front()->mass().end());
  BodyTotals totals;
  unsigned left = 0;
  for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    if (left == 0) {
      if (totals.bodies > 0) body.scene.reset();
      ++totals.bodies;
      left = 10 + seed % 16;
    }
    --left;
    // where the body is now: cuts add vertices, but none outside
    RandomCut cut = RandomCuts(seed, *divider.complex, divider.cutter->spacing()).next();
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + cut.kind + ", body " +
                 std::to_string(totals.bodies));
    ++totals.cuts;
    if (!cutOnce(body, cut, effort.checkEvery, totals)) break;
    AllFacets facets(divider.facets->facets());
    const auto from = static_cast<Index>(seed % static_cast<unsigned>(effort.askEvery));
    askLinks(body, facets, from, effort.askEvery, totals);
    askSupports(body, facets, from, effort.askEvery, totals);
    totals.facets += static_cast<long>(divider.facets->count());
    const SurfaceNumbers numbers = checkInvariants(*divider.complex, divider.volume);
    totals.slivers = std::max(totals.slivers, numbers.sliverFraction);
    totals.angle = std::min(totals.angle, numbers.smallestAngle);
    EXPECT_TRUE(std::ranges::equal(body.scene.systems().front()->mass(), mass)) << "to the bit";
  }
  totals.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf(
      "seeds %u to %u: %ld cuts of %ld bodies, %ld changes, %ld checks; %ld links and %ld supports "
      "asked of %ld facets in the mean; free chips in one body at most %ld, rows asked with fewer "
      "than 8 links %ld; worst slivers %.2f %%, smallest angle %.2g deg; %.1f s\n",
      first, first + count - 1, totals.cuts, totals.bodies, totals.changes, totals.checks,
      totals.links, totals.supports, totals.facets / std::max(1L, totals.cuts), totals.chips,
      totals.few, 100 * totals.slivers, totals.angle, totals.seconds);
  return totals;
}

std::string corneaToDivide() {
  return R"(<Node dt="1 ms" gravity="0 0 0"><Node name="body"><include href="tissue.xml"/>
    <MeshGmshLoader name="solid" filename="../meshes/cornea_shell.msh"/>
    <RandomDivider particles="@state" nodes="@surface/nodes" surface="@surface/mesh"
                   solid="@solid"/></Node></Node>)";
}

std::string liverToDivide() {
  return R"(<Node dt="0.5 ms" gravity="0 0 0"><Node name="body">
    <EulerExplicitSolver rayleighMass="10"/>
    <MeshOBJLoader name="mesh" filename="../meshes/liver.obj"/>
    <MeshGmshLoader name="solid" filename="../meshes/liver.msh"/>
    <ParticleSampler name="particles" surface="@mesh" count="3024" seed="1"/>
    <MechanicalObject name="state" src="@particles"/>
    <DiagonalMass massDensity="1050 kg/m^3"/>
    <MLSForceField src="@particles" strain="corotated" youngModulus="10 kPa" poissonRatio="0.33"
                   supportCount="16"/>
    <Node name="surface"><MeshTopology name="mesh" src="@../mesh"/><MechanicalObject name="nodes"/>
      <MLSMapping/></Node>
    <RandomDivider particles="@state" nodes="@surface/nodes" surface="@surface/mesh"
                   solid="@solid"/></Node></Node>)";
}

}  // namespace stroma::test
