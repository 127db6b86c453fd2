// SPDX-License-Identifier: Apache-2.0
#include "tools/view/carried_state.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/interfaces/integrator.h"
#include "core/traverse.h"

namespace stroma::view {
namespace {

using States = std::map<std::string, const MechanicalState*>;

States independentStates(Scene& scene) {
  States states;
  for (const auto& system : scene.systems()) {
    for (const MechanicalState* state : system->states()) states.emplace(state->path(), state);
  }
  return states;
}

bool isSameAtRest(const MechanicalState& a, const MechanicalState& b) {
  return a.size() == b.size() && std::ranges::equal(a.rest(), b.rest());
}

std::map<std::string, std::string> types(Scene& scene) {
  std::map<std::string, std::string> all;
  forEachComponent(scene.root(), [&](const Component& c) { all.emplace(c.path(), c.type()); });
  return all;
}

}  // namespace

bool carryState(Scene& from, Scene& to) {
  const States old = independentStates(from);
  const States now = independentStates(to);
  const bool same = std::ranges::all_of(now, [&](const auto& entry) {
    const auto before = old.find(entry.first);
    return before != old.end() && isSameAtRest(*before->second, *entry.second);
  });
  if (!same) return false;

  const Snapshot before = from.save();
  Snapshot carried = to.save();
  carried.step = static_cast<std::uint64_t>(
      std::max(0.0, std::round((from.time() - to.root().time) / to.dt())));
  const auto oldTypes = types(from);
  for (const auto& [path, type] : types(to)) {
    const auto known = oldTypes.find(path);
    if (known == oldTypes.end() || known->second != type) continue;
    const auto isOwn = [prefix = path + "#"](const auto& chunk) {
      return chunk.first.starts_with(prefix);
    };
    std::erase_if(carried.chunks, isOwn);
    for (const auto& chunk : before.chunks) {
      if (isOwn(chunk)) carried.chunks.insert(chunk);
    }
  }
  for (const auto& system : to.systems()) {
    std::vector<Vec3> x, v, f;
    for (const MechanicalState* state : system->states()) {
      const MechanicalState& source = *old.at(state->path());
      x.insert(x.end(), source.x().begin(), source.x().end());
      v.insert(v.end(), source.v().begin(), source.v().end());
      f.insert(f.end(), source.f().begin(), source.f().end());
    }
    StateWriter writer(carried.chunks, system->integrator().path());
    writer.write("system.x", ConstVec3Span(x));
    writer.write("system.v", ConstVec3Span(v));
    writer.write("system.f", ConstVec3Span(f));
  }
  if (to.restore(carried)) return true;
  to.reset();
  return false;
}

}  // namespace stroma::view
