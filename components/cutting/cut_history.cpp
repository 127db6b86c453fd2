// SPDX-License-Identifier: Apache-2.0
#include "components/cutting/cut_history.h"

namespace stroma {

SurfaceEdit CutHistory::advance(Cutter& cutter, std::vector<Vec3> edge, double longest) {
  const Index poses = cutter.poseCount();
  SurfaceEdit edit = cutter.advance(edge, longest);
  if (cutter.poseCount() != poses) {
    recordHeld();
    record(false, edge, longest);
  } else {
    held_ = std::move(edge);
    heldLongest_ = longest;
  }
  return edit;
}

SurfaceEdit CutHistory::finish(Cutter& cutter, ConstVec3Span edge) {
  recordHeld();
  record(true, edge, 0);
  return cutter.finish(edge);
}

void CutHistory::record(bool finish, ConstVec3Span edge, double longest) {
  events_.insert(events_.end(), {finish ? 0.0 : 1.0, static_cast<double>(edge.size()), longest});
  for (const Vec3& p : edge) events_.insert(events_.end(), {p.x(), p.y(), p.z()});
}

void CutHistory::recordHeld() {
  if (!held_.empty()) record(false, held_, heldLongest_);
  held_.clear();
}

void CutHistory::save(StateWriter& writer) const {
  CutHistory whole = *this;
  whole.recordHeld();
  writer.write("history", std::span<const double>(whole.events_));
}

void CutHistory::replay(StateReader& reader, Cutter& cutter,
                        const std::function<void(const SurfaceEdit&)>& change) {
  clear();
  std::vector<double> events(reader.count<double>("history"));
  if (!reader.read("history", std::span(events))) return;
  constexpr std::size_t head = 3;
  for (std::size_t k = 0; k + head <= events.size();) {
    const bool ends = events[k] == 0;
    const auto points = static_cast<std::size_t>(events[k + 1]);
    const double longest = events[k + 2];
    k += head;
    // a pose has two points at least; a cut may end without one
    if (points > (events.size() - k) / 3 || points == 1 || (points == 0 && !ends)) return;
    std::vector<Vec3> edge(points);
    for (Vec3& p : edge)
      for (double& component : p) component = events[k++];
    const SurfaceEdit edit = ends ? finish(cutter, edge) : advance(cutter, edge, longest);
    if (!edit.empty()) change(edit);
  }
}

}  // namespace stroma
