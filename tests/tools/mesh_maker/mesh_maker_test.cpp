// SPDX-License-Identifier: Apache-2.0
// The meshes that the scenes use, as they are shipped: SCENE_MESHES is their folder, MESH_MAKER the
// tool that made them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "components/sampling/shell_sampler.h"
#include "components/sampling/surface_check.h"
#include "components/sampling/volume_sampler.h"

namespace stroma {
namespace {

namespace fs = std::filesystem;

struct ObjFile : SurfaceMesh {
  std::map<std::string, std::vector<Triangle>> groups;
  std::string rimBoxes;
};

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

ObjFile load(const std::string& name) {
  std::istringstream file(contentOf(fs::path(SCENE_MESHES) / name));
  ObjFile mesh;
  std::string line, word, group;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vec3& p = mesh.positions.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (word == "g") {
      words >> group;
    } else if (word == "f") {
      Triangle& t = mesh.triangles.emplace_back();
      for (Index& v : t) words >> v, --v;
      mesh.groups[group].push_back(t);
    } else if (const auto at = line.find("box=\""); at != std::string::npos) {
      mesh.rimBoxes = line.substr(at + 5, line.size() - at - 6);
    }
  }
  return mesh;
}

void expectCounts(const SurfaceMesh& m, int nodes, int triangles, int euler,
                  std::vector<std::size_t> rims) {
  EXPECT_EQ(m.positions.size(), static_cast<std::size_t>(nodes));
  EXPECT_EQ(m.triangles.size(), static_cast<std::size_t>(triangles));
  const auto edges = static_cast<int>(uniqueEdges(m.triangles).size());
  EXPECT_EQ(nodes - edges + triangles, euler);
  std::vector<std::size_t> found;
  for (const auto& loop : boundaryLoops(m.triangles)) found.push_back(loop.size());
  EXPECT_EQ(found, rims);
  for (const SurfaceFinding& f : checkSurface(m.positions, m.triangles))
    EXPECT_EQ(f.fault, SurfaceFault::openRim) << f.text;
}

// 1 for an equilateral triangle, 0 for a sliver.
double worstShape(const SurfaceMesh& m) {
  double worst = 1;
  for (const Triangle& t : m.triangles) {
    double squares = 0;
    for (int k = 0; k < 3; ++k)
      squares += (m.positions[t[(k + 1) % 3]] - m.positions[t[k]]).squaredNorm();
    worst = std::min(worst, 4 * std::sqrt(3.0) * vectorArea(m.positions, t).norm() / squares);
  }
  return worst;
}

bool segmentPierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto volume = [](const Vec3& o, const Vec3& u, const Vec3& v, const Vec3& w) {
    return (u - o).cross(v - o).dot(w - o);
  };
  if (volume(a, b, c, p) * volume(a, b, c, q) >= 0) return false;
  const double s0 = volume(p, q, a, b), s1 = volume(p, q, b, c), s2 = volume(p, q, c, a);
  return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
}

// Edges that pierce triangles they share no node with.
int selfIntersections(const SurfaceMesh& m) {
  int count = 0;
  for (const Edge& e : uniqueEdges(m.triangles))
    for (const Triangle& t : m.triangles) {
      if (std::any_of(t.begin(), t.end(), [&](Index v) { return v == e[0] || v == e[1]; }))
        continue;
      count += segmentPierces(m.positions[e[0]], m.positions[e[1]], m.positions[t[0]],
                              m.positions[t[1]], m.positions[t[2]]);
    }
  return count;
}

Vec3 extent(const SurfaceMesh& m) {
  Vec3 low = m.positions[0], high = low;
  for (const Vec3& p : m.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

TEST(Meshes, corneaSheetIsThePapersDisk) {
  const ObjFile m = load("cornea_sheet.obj");
  expectCounts(m, 192, 350, 1, {32});
  const Vec3 size = extent(m);
  EXPECT_NEAR(size[0], 11.8e-3, 1e-8);
  EXPECT_NEAR(size[1], 10.8e-3, 1e-8);
  for (const Vec3& p : m.positions) EXPECT_NEAR((p + Vec3(0, 0, 7.8e-3)).norm(), 7.8e-3, 2e-9);
  EXPECT_GT(worstShape(m), 0.6);
}

TEST(Meshes, corneaShellIsClosedAndAsThickAsACornea) {
  const ObjFile m = load("cornea_shell.obj");
  expectCounts(m, 938, 1872, 2, {});
  EXPECT_EQ(whyNotClosed(m.positions, m.triangles), "");
  const std::size_t half = m.positions.size() / 2;
  double thinnest = 1, thickest = 0;
  for (std::size_t i = 0; i < half; ++i) {
    const double t = (m.positions[i] - m.positions[i + half]).norm();
    thinnest = std::min(thinnest, t);
    thickest = std::max(thickest, t);
  }
  EXPECT_NEAR(thinnest, 0.58e-3, 2e-9);
  EXPECT_NEAR(thickest, 0.64e-3, 2e-9);
  EXPECT_EQ(m.groups.at("anterior").size(), 864u);
  EXPECT_EQ(m.groups.at("posterior").size(), 864u);
  EXPECT_EQ(m.groups.at("rim").size(), 144u);
}

TEST(Meshes, theWrittenBoxesSelectTheRimAndNothingElse) {
  for (const char* name : {"cornea_shell.obj", "cornea_cap.obj"}) {
    const ObjFile m = load(name);
    std::vector<bool> isRim(m.positions.size(), false), isSelected(m.positions.size(), false);
    for (const Triangle& t : m.groups.at("rim"))
      for (const Index v : t) isRim[v] = true;
    std::istringstream numbers(m.rimBoxes);
    int boxes = 0;
    for (Vec3 a, b; numbers >> a[0] >> a[1] >> a[2] >> b[0] >> b[1] >> b[2]; ++boxes)
      for (std::size_t i = 0; i < m.positions.size(); ++i)
        if ((m.positions[i].array() >= a.array()).all() &&
            (m.positions[i].array() <= b.array()).all())
          isSelected[i] = true;
    EXPECT_EQ(isSelected, isRim) << name;
    std::printf("%s: %d boxes\n", name, boxes);
  }
}

TEST(Meshes, corneaCapHasTheSmoothCapsVolume) {
  const ObjFile m = load("cornea_cap.obj");
  expectCounts(m, static_cast<int>(m.positions.size()), static_cast<int>(m.triangles.size()), 2,
               {});
  const double volume = enclosedVolume(m.positions, m.triangles);
  std::printf("%zu nodes, volume %.4f mm^3 (smooth: 63.866)\n", m.positions.size(), volume * 1e9);
  EXPECT_NEAR(volume / 63.866e-9, 1, 3e-3);
}

TEST(Meshes, liverIsClosedWellShapedAndDoesNotCrossItself) {
  const ObjFile m = load("liver.obj");
  expectCounts(m, 502, 1000, 2, {});
  EXPECT_EQ(whyNotClosed(m.positions, m.triangles), "");
  const Vec3 size = extent(m);
  std::printf("%.1f x %.1f x %.1f cm, %.0f ml, worst triangle %.2f\n", size[0] * 100, size[1] * 100,
              size[2] * 100, enclosedVolume(m.positions, m.triangles) * 1e6, worstShape(m));
  EXPECT_GT(worstShape(m), 0.5);
  EXPECT_EQ(selfIntersections(m), 0);
  EXPECT_GT(size[0], 0.15);
  EXPECT_LT(size[0], 0.20);
}

TEST(Meshes, stomachHasTwoOpeningsAndEnclosesItsBagWhenCapped) {
  const ObjFile m = load("stomach.obj");
  expectCounts(m, 512, 991, 0, {16, 17});
  EXPECT_GT(worstShape(m), 0.5);
  EXPECT_EQ(selfIntersections(m), 0);
  const SurfaceMesh closed = capRims(m.positions, m.triangles);
  EXPECT_EQ(whyNotClosed(closed.positions, closed.triangles), "");
  std::printf("%.0f ml, worst triangle %.2f\n",
              enclosedVolume(closed.positions, closed.triangles) * 1e6, worstShape(m));
}

TEST(Meshes, allAreFilledWithTheirParticles) {
  const ObjFile liver = load("liver.obj");
  EXPECT_EQ(sampleVolume(liver.positions, liver.triangles, {.count = 3024}).problem, "");
  const ObjFile bag = load("stomach.obj");
  const SurfaceMesh stomach = capRims(bag.positions, bag.triangles);
  EXPECT_EQ(sampleVolume(stomach.positions, stomach.triangles, {.count = 3024}).problem, "");
  const ObjFile cornea = load("cornea_shell.obj");
  const ShellSamples s = sampleShell(cornea.positions, cornea.triangles, {.count = 1500});
  ASSERT_EQ(s.problem, "");
  for (std::size_t c = 0; c < 1500; c += 3) {
    const Vec3 radial = (s.positions[c] + Vec3(0, 0, 7.8e-3)).normalized();
    EXPECT_GT(radial.dot(s.normals[c]), 0.99);
  }
}

TEST(MeshMaker, makesTheShippedFilesBitForBit) {
  const fs::path folder = fs::path(testing::TempDir()) / "stroma_meshes";
  const std::string command = std::string(MESH_MAKER) + " all --out " + folder.string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const char* name :
       {"cornea_sheet.obj", "cornea_shell.obj", "cornea_cap.obj", "liver.obj", "stomach.obj"})
    EXPECT_EQ(contentOf(folder / name), contentOf(fs::path(SCENE_MESHES) / name)) << name;
  fs::remove_all(folder);
}

TEST(MeshMaker, exitCodesTellUsageFromFileTrouble) {
  const auto exitCode = [](const std::string& arguments) {
    const int status =
        std::system((std::string(MESH_MAKER) + " " + arguments + " >/dev/null 2>&1").c_str());
    return status / 256;
  };
  EXPECT_EQ(exitCode("--help"), 0);
  EXPECT_EQ(exitCode(""), 1);
  EXPECT_EQ(exitCode("pancreas"), 1);
  EXPECT_EQ(exitCode("cornea-cap --rings 0"), 1);
  EXPECT_EQ(exitCode("liver --out /no/such/folder/liver.obj"), 4);
}

}  // namespace
}  // namespace stroma
