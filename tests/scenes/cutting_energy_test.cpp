// SPDX-License-Identifier: Apache-2.0
// The energy of bodies while they are cut: no step gives them more than the tools' work.
#include "tests/scenes/cutting_scenes.h"

namespace stroma::test {
namespace {

// What the tissue stores, and what everything else does to it.
class EnergyAccount {
 public:
  explicit EnergyAccount(CuttingScene& run) : run_(run) {
    for (ForceField* field : run.system().forceFields())
      (isTissue(*field) ? tissue_ : others_).push_back(field);
  }
  [[nodiscard]] double stored() {
    double sum = run_.system().kineticEnergy(run_.system().v());
    for (ForceField* field : tissue_)
      sum += field->potentialEnergy(field->state().view(run_->time()));
    return sum;
  }
  // Work of the others on the way from `before`, with the forces at its one end or at the other,
  // whichever is more.
  [[nodiscard]] double workSince(const std::vector<Vec3>& before) {
    System& system = run_.system();
    const std::vector<Vec3> now(system.x().begin(), system.x().end());
    std::vector<std::vector<Vec3>> way, forces;
    for (ForceField* field : others_) {
      way.emplace_back(field->state().x().begin(), field->state().x().end());
      forces.push_back(force(*field));
    }
    std::ranges::copy(before, system.x().begin());
    system.updateMapped();
    double late = 0, early = 0;
    for (std::size_t k = 0; k < others_.size(); ++k) {
      const std::vector<Vec3> first = force(*others_[k]);
      for (std::size_t i = 0; i < first.size(); ++i) {
        const Vec3 moved = way[k][i] - others_[k]->state().x()[i];
        late += forces[k][i].dot(moved);
        early += first[i].dot(moved);
      }
    }
    std::ranges::copy(now, system.x().begin());
    system.updateMapped();
    return std::max(late, early);
  }

 private:
  static bool isTissue(const ForceField& field) { return field.type() == "MLSForceField"; }
  std::vector<Vec3> force(ForceField& field) {
    std::vector<Vec3> f(static_cast<std::size_t>(field.state().size()), Vec3::Zero());
    field.addForce(field.state().view(run_->time()), f);
    return f;
  }
  CuttingScene& run_;
  std::vector<ForceField*> tissue_, others_;
};

class CuttingEnergy : public testing::TestWithParam<const char*> {};

TEST_P(CuttingEnergy, growsByNoMoreThanTheToolsWork) {
  CuttingScene run(GetParam(), {}, Made::here);
  EnergyAccount account(run);
  const auto resistances = collect<CuttingResistance>(run->root());
  const auto parting = [&] { return resistances.empty() ? 0 : *resistances.front()->work; };
  double most = 0, worst = -1e300, added = 0;
  // a change frees at once what the blade has parted since the one before
  double parted = parting();
  int changes = 0;
  while (run->stepCount() < run.lastStep()) {
    const std::vector<Vec3> x(run.system().x().begin(), run.system().x().end());
    const double before = account.stored();
    const double changesBefore = run.attribute("changes"),
                 addedBefore = run.attribute("addedEnergy");
    ASSERT_TRUE(run->step());
    const double after = account.stored();
    most = std::max(most, after);
    if (run.attribute("changes") == changesBefore) continue;
    ++changes;
    const double addedNow = std::max(0.0, run.attribute("addedEnergy") - addedBefore);
    added += addedNow;
    if (!resistances.empty()) {
      EXPECT_LE(addedNow, parting() - parted);
    }
    worst = std::max(worst, after - before - account.workSince(x) - (parting() - parted));
    parted = parting();
  }
  std::printf(
      "%s: %d steps with changes, which add %.1e J, %.1e taken from the motion; the most "
      "that a step gains beyond the work of the tools: %+.1e of %.2e J\n",
      GetParam(), changes, added, run.attribute("takenEnergy"), worst / most, most);
  EXPECT_GT(changes, 0);
  EXPECT_LE(worst, 1e-6 * most);
}

INSTANTIATE_TEST_SUITE_P(Scenes, CuttingEnergy,
                         testing::Values("cornea/cut.xml", "cornea/keratome.xml",
                                         "cornea/trephine.xml", "liver/cut.xml", "stomach/cut.xml"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

// An explicit solver keeps energy only in the mean over an oscillation, so that no single step can
// tell; there all that the changes have added is taken back.
TEST(CuttingEnergyOfThePapersScene, isTakenBack) {
  CuttingScene run("paper/cut.xml");
  double added = 0, last = 0, most = 0;
  while (run->stepCount() < run.lastStep()) {
    ASSERT_TRUE(run->step());
    const double now = run.attribute("addedEnergy");
    added += std::max(0.0, now - last);
    last = now;
    most = std::max(most, added - run.attribute("takenEnergy"));
  }
  std::printf("added %.4e J, taken %.4e J, owed meanwhile at most %.1e J\n", added,
              run.attribute("takenEnergy"), most);
  EXPECT_GT(added, 0);
  EXPECT_NEAR(run.attribute("takenEnergy"), added, 1e-6 * added);
}

}  // namespace
}  // namespace stroma::test
