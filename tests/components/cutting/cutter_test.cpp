// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iostream>
#include <numbers>

#include "components/cutting/seam_measure.h"
#include "tests/components/cutting/cut_runner.h"
#include "tests/components/cutting/test_bodies.h"

namespace stroma::test {
namespace {

void print(const char* name, const SimplicialComplex& complex, const Worst& w) {
  const SurfaceNumbers n = checkInvariants(complex);
  std::cout << name << ": " << complex.simplexCount() << " simplices, " << w.steps
            << " changes, pieces " << n.pieces.size() << ", chi " << n.euler() << ", walls "
            << n.walls << ", smallest angle " << w.angle << " deg, slivers " << 100 * w.slivers
            << " %, openness " << w.openness << ", volume mismatch " << w.volume << '\n';
}

Sweep circle(double radius, double turns, double top, double bottom) {
  return [=](double s) {
    const double a = 2 * std::numbers::pi * turns * s;
    const Vec3 x(radius * std::cos(a), radius * std::sin(a), 0);
    return blade(x + Vec3(0, 0, top), x + Vec3(0, 0, bottom));
  };
}

// A wavy line across the middle, from x = `from` to x = `to`, and its blade.
Vec3 wave(double x) { return {x, 0.8e-3 * std::sin(x / 1.5e-3) + 0.17e-3, 0}; }
Sweep waveCut(double from, double to, double top, double bottom) {
  return [=](double s) {
    const Vec3 x = wave(from + s * (to - from));
    return blade(x + Vec3(0, 0, top), x + Vec3(0, 0, bottom));
  };
}

constexpr double mm = 1e-3;

// === Solids

TEST(CutSolid, slitKeepsOnePieceAndTheSphereTopology) {
  SimplicialComplex body = solid(block(Vec3::Constant(10 * mm), {8, 8, 8}, 0.2, 1));
  const double volume = checkInvariants(body).volume;
  Cutter cutter(body);
  const Worst w = runCut(
      body, cutter,
      straight({-2 * mm, 5.2 * mm, 0}, {5.8 * mm, 4.5 * mm, 0}, {0, 0, 11 * mm}, {0, 0, 5.3 * mm}),
      40, volume);
  print("slit", body, w);
  EXPECT_EQ(pieceCount(body), 1);
  EXPECT_EQ(checkInvariants(body).euler(), 2);
}

TEST(CutSolid, slotRightThroughIsAHandle) {
  SimplicialComplex body = solid(block(Vec3::Constant(10 * mm), {8, 8, 8}, 0.2, 1));
  Cutter cutter(body);
  const Worst w = runCut(
      body, cutter,
      straight({3 * mm, 5.2 * mm, 0}, {7 * mm, 4.9 * mm, 0}, {0, 0, 11 * mm}, {0, 0, -1 * mm}), 40,
      0);
  print("slot", body, w);
  EXPECT_EQ(pieceCount(body), 1);
  EXPECT_EQ(checkInvariants(body).euler(), 0);
}

TEST(CutSolid, fullCutMakesTwoClosedPieces) {
  SimplicialComplex body = solid(block(Vec3::Constant(10 * mm), {8, 8, 8}, 0.2, 2));
  const double volume = checkInvariants(body).volume;
  Cutter cutter(body);
  const Worst w = runCut(body, cutter,
                         straight({-2 * mm, 5.2 * mm, 0}, {12 * mm, 4.5 * mm, 0}, {0, 0, 11 * mm},
                                  {0, 1 * mm, -1 * mm}),
                         40, volume);
  print("full cut", body, w);
  const SurfaceNumbers n = checkInvariants(body, volume);
  ASSERT_EQ(n.pieces.size(), 2U);
  EXPECT_EQ(n.pieces[0].euler(), 2);
  EXPECT_EQ(n.pieces[1].euler(), 2);
}

TEST(CutSolid, trephineThroughTheShellFreesAButtonAndLeavesARing) {
  for (const double turns : {1.0, 1.03}) {
    SimplicialComplex body = solid(shell(20, 2));
    const double volume = checkInvariants(body).volume;
    Cutter cutter(body);
    const Worst w =
        runCut(body, cutter, circle(3.75 * mm, turns, 0.5 * mm, -2.5 * mm), 120, volume);
    print("trephine", body, w);
    const SurfaceNumbers n = checkInvariants(body, volume);
    ASSERT_EQ(n.pieces.size(), 2U);
    EXPECT_EQ(std::min(n.pieces[0].euler(), n.pieces[1].euler()), 0);
    EXPECT_EQ(std::max(n.pieces[0].euler(), n.pieces[1].euler()), 2);
  }
}

TEST(CutSolid, ringPushedThroughTheShellFreesAButton) {
  SimplicialComplex body = solid(shell(20, 2));
  const double volume = checkInvariants(body).volume;
  Cutter cutter(body);
  const Sweep ring = [](double s) {
    std::vector<Vec3> points;
    for (int k = 0; k <= 48; ++k) {
      const double a = 2 * std::numbers::pi * (k % 48) / 48;
      points.emplace_back(3.75 * mm * std::cos(a), 3.75 * mm * std::sin(a), (0.5 - 3.2 * s) * mm);
    }
    return points;
  };
  const Worst w = runCut(body, cutter, ring, 60, volume);
  print("ring", body, w);
  EXPECT_EQ(pieceCount(body), 2);
}

TEST(CutSolid, theScenesCorneaLosesAButtonOfSevenAndAHalfMillimetres) {
  SimplicialComplex body = sceneSolid("cornea_shell");
  const SurfaceNumbers before = checkInvariants(body);
  EXPECT_TRUE(before.failures.empty());
  Cutter cutter(body);
  const Worst w =
      runCut(body, cutter, circle(3.75 * mm, 1.0, 1 * mm, -3.5 * mm), 240, before.volume);
  print("cornea, trephine", body, w);
  EXPECT_EQ(pieceCount(body), 2);
  EXPECT_LT(w.slivers, 0.02);
  const auto lines = seamLines(body);
  ASSERT_GE(lines.size(), 2U);
  std::cout << "  seams " << lineLength(lines[0]) << " m and " << lineLength(lines[1])
            << " m, circle " << 2 * std::numbers::pi * 3.75 * mm << " m\n";
  EXPECT_NEAR(lineLength(lines[0]), 2 * std::numbers::pi * 3.75 * mm, 0.03 * 0.0236);
}

TEST(CutSolid, theScenesLiverTakesASlit) {
  SimplicialComplex body = sceneSolid("liver");
  const SurfaceNumbers before = checkInvariants(body);
  EXPECT_TRUE(before.failures.empty());
  Cutter cutter(body);
  const Worst w = runCut(
      body, cutter,
      straight({-60 * mm, 3 * mm, 0}, {10 * mm, -4 * mm, 0}, {0, 0, 90 * mm}, {0, 0, 20 * mm}), 40,
      before.volume);
  print("liver", body, w);
  EXPECT_EQ(pieceCount(body), 1);
  EXPECT_GT(checkInvariants(body).walls, 0);
  EXPECT_LT(w.slivers, 0.02);
}

// === Open sheets: the predictions for a disk

TEST(CutSheetBody, slitFromTheRimKeepsTheDisk) {
  SimplicialComplex body = disk(6 * mm, 10, 7.8 * mm);
  Cutter cutter(body);
  const Worst w = runCut(body, cutter, waveCut(-7 * mm, 1.3 * mm, 1 * mm, -5 * mm), 60, 0);
  print("rim slit", body, w);
  EXPECT_EQ(pieceCount(body), 1);
  EXPECT_EQ(checkInvariants(body).euler(), 1);
}

TEST(CutSheetBody, slitInsideMakesANewRim) {
  SimplicialComplex body = disk(6 * mm, 10, 7.8 * mm);
  Cutter cutter(body);
  const Worst w = runCut(body, cutter, waveCut(-3 * mm, 2.7 * mm, 1 * mm, -5 * mm), 60, 0);
  print("inner slit", body, w);
  EXPECT_EQ(pieceCount(body), 1);
  EXPECT_EQ(checkInvariants(body).euler(), 0);
}

TEST(CutSheetBody, cutAcrossMakesTwoDisks) {
  SimplicialComplex body = disk(6 * mm, 10, 7.8 * mm);
  Cutter cutter(body);
  const Worst w = runCut(body, cutter, waveCut(-7 * mm, 7 * mm, 1 * mm, -5 * mm), 80, 0);
  print("across", body, w);
  EXPECT_EQ(pieceCount(body), 2);
  EXPECT_EQ(checkInvariants(body).euler(), 2);
}

TEST(CutSheetBody, loopMakesADiskAndAnAnnulus) {
  for (const double turns : {1.0, 1.05}) {
    SimplicialComplex body = disk(6 * mm, 10, 7.8 * mm);
    Cutter cutter(body);
    const Worst w = runCut(body, cutter, circle(3.75 * mm, turns, 1 * mm, -5 * mm), 100, 0);
    print("loop", body, w);
    EXPECT_EQ(pieceCount(body), 2);
    EXPECT_EQ(checkInvariants(body).euler(), 1);
  }
}

// === Fidelity

struct Fidelity {
  double length = 0, trueLength = 0;
  Smoothness smooth;
};

Fidelity cutAndMeasure(SimplicialComplex body, bool subdivide, double from, double to,
                       const std::function<double(double, double)>& height) {
  const double edge = body.meanEdgeLength();
  CutterOptions options;
  options.subdivide = subdivide;
  Cutter cutter(body, 0, options);
  (void)runCut(body, cutter, waveCut(from, to, 2 * mm, -6 * mm), 100, 0);
  std::vector<Vec3> path;
  for (int k = 0; k <= 2000; ++k) {
    Vec3 x = wave(from + (to - from) * k / 2000.0);
    x.z() = height(x.x(), x.y());
    path.push_back(x);
  }
  Fidelity result;
  result.trueLength = lineLength(path);
  // of a solid's seams the one on top
  std::vector<std::vector<Vec3>> lines = seamLines(body);
  std::erase_if(lines, [&](const auto& line) {
    return std::abs(line[line.size() / 2].z() -
                    height(line[line.size() / 2].x(), line[line.size() / 2].y())) > 0.2 * mm;
  });
  if (lines.empty()) return result;
  result.length = lineLength(lines[0]);
  result.smooth = smoothness(lines[0], path, edge);
  return result;
}

void compare(const char* name, const SimplicialComplex& body, double from, double to,
             const std::function<double(double, double)>& height) {
  const Fidelity fine = cutAndMeasure(body, true, from, to, height),
                 rough = cutAndMeasure(body, false, from, to, height);
  std::cout << name << ": path " << fine.trueLength << " m, subdivided " << fine.length
            << " (turning " << fine.smooth.meanTurning << " rad, deviation "
            << fine.smooth.meanDeviation << " edges), not " << rough.length << " (turning "
            << rough.smooth.meanTurning << ", deviation " << rough.smooth.meanDeviation << ")\n";
  EXPECT_NEAR(fine.length, fine.trueLength, 0.03 * fine.trueLength);
  EXPECT_LT(2 * fine.smooth.meanTurning, rough.smooth.meanTurning);
  EXPECT_LT(2 * fine.smooth.meanDeviation, rough.smooth.meanDeviation);
}

TEST(CutFidelity, incisionHasThePathsLengthAndIsTwiceAsSmoothAsWithoutSubdivision) {
  const auto flat = [](double, double) { return 0.0; };
  const auto dome = [](double x, double y) {
    return std::sqrt(7.8 * mm * 7.8 * mm - x * x - y * y) - 7.8 * mm;
  };
  compare("flat sheet", disk(6 * mm, 10, 0), -3.1 * mm, 2.7 * mm, flat);
  compare("bent sheet", disk(6 * mm, 10, 7.8 * mm), -3.1 * mm, 2.7 * mm, dome);
  compare("shell", solid(shell(20, 2)), -2.9 * mm, 2.3 * mm, dome);
}

TEST(Cutter, aPoseThatIsNoneLeavesItReady) {
  SimplicialComplex body = solid(block(Vec3::Constant(0.004), {4, 4, 4}, 0, 1));
  Cutter cutter(body);
  const std::vector<Vec3> bad{Vec3::Zero(), Vec3::Constant(std::nan(""))};
  EXPECT_THROW(cutter.advance(bad), std::invalid_argument);
  EXPECT_FALSE(cutter.cutting());
  for (int k = 0; k < 4; ++k) {
    const Vec3 x(0.001 * k, 0.0021, 0);
    cutter.advance(blade(x + Vec3(0, 0, 0.005), x + Vec3(0, 0, 0.002)));
  }
  EXPECT_FALSE(body.separatedFacets().empty());
}

TEST(Complex, aCornerThatIsNoVertexIsRefused) {
  const std::vector<Vec3> points{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const std::vector<Tetrahedron> bad{{0, 1, 2, 4}};
  EXPECT_THROW((void)SimplicialComplex::fromTetrahedra(points, bad), std::invalid_argument);
}

}  // namespace
}  // namespace stroma::test
