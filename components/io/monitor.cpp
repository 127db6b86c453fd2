// SPDX-License-Identifier: Apache-2.0
#include "components/io/monitor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "core/scene.h"

namespace stroma {
namespace {

std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

// The vector's wanted parts with the endings of their names.
std::vector<std::pair<std::string, double>> parts(const Vec3& v, Part part) {
  switch (part) {
    case Part::x:
      return {{"", v.x()}};
    case Part::y:
      return {{"", v.y()}};
    case Part::z:
      return {{"", v.z()}};
    case Part::norm:
      return {{"", v.norm()}};
    case Part::vector:
      break;
  }
  return {{"_x", v.x()}, {"_y", v.y()}, {"_z", v.z()}};
}

// The step that a row of the table begins with; none for other lines.
std::optional<std::uint64_t> stepOf(const std::string& row) {
  std::uint64_t step = 0;
  const auto [end, failure] = std::from_chars(row.data(), row.data() + row.size(), step);
  if (failure != std::errc() || *end != ',') return std::nullopt;
  return step;
}

}  // namespace

void Monitor::configure() {
  Recorder::configure();
  if (!attribute.isSet()) {
    if (!mechanicalState) {
      error("attr-required", "has nothing to record: give 'state' or 'attribute'");
    }
  } else if (!attribute.source()) {
    error(attribute, "link-syntax", "is a link to an attribute: \"@component.attribute\"");
  } else if (quantity.isSet()) {
    error(quantity, "attr-conflict", "and 'attribute' cannot both be recorded by one Monitor");
  }
  if (since.isSet() && (attribute.isSet() || quantity != Quantity::displacement)) {
    error(since, "attr-conflict", "has a meaning for quantity=\"displacement\" only");
  }
}

void Monitor::bind() {
  if (attribute.isSet()) return;
  const Index count = mechanicalState->size();
  particles_ = indices->indices;
  if (!indices.isSet()) {
    particles_.resize(static_cast<std::size_t>(count));
    std::iota(particles_.begin(), particles_.end(), 0);
  }
  chosen_ = particles_.size();
  if (particles_.empty()) {
    error(indices, "monitor-empty", "chooses no particle");
  } else if (const Index last = std::ranges::max(particles_); last >= count) {
    error(indices, "index-range",
          "has particle " + std::to_string(last) + "; the state has " + std::to_string(count));
  }
}

void Monitor::start() {
  started_ = true;
  if (attribute.isSet() && sampleAttribute().components == 0) {
    error(attribute, "link-type",
          "links to '" + std::string(attribute.source()->name()) + "' (" +
              attribute.source()->typeName() + "), which is no number");
  }
}

void Monitor::schedule(Schedule& schedule) {
  if (since.isSet()) {
    schedule.add<&Monitor::takeReference>(Stage::Guard, *this, "reference when due");
  }
  Recorder::schedule(schedule);
}

void Monitor::topologyChanged(const TopologyChange& change) {
  if (attribute.isSet() || &change.nodes != mechanicalState.get()) return;
  if (reduce == Reduction::each) return;
  const std::size_t before = particles_.size();
  if (indices.isSet()) {
    change.follow(particles_);
  } else {
    for (Index i = change.edit.firstNewNode; i < change.nodes.size(); ++i) particles_.push_back(i);
  }
  if (!reference_.empty()) followReference(change, before);
}

// New nodes were where the surface was; those that come from inside count from where they are now.
void Monitor::followReference(const TopologyChange& change, std::size_t firstNew) {
  const auto at = [&](Index particle) {
    const auto k = std::ranges::find(particles_, particle) - particles_.begin();
    return reference_[static_cast<std::size_t>(k)];
  };
  for (std::size_t k = firstNew; k < particles_.size(); ++k) {
    const Index i = particles_[k];
    const NewSurfaceNode& node =
        change.edit.nodes[static_cast<std::size_t>(i - change.edit.firstNewNode)];
    Vec3 reference = mechanicalState->x()[static_cast<std::size_t>(i)];
    if (node.copyOf >= 0) {
      reference = at(node.copyOf);
    } else if (node.parents[0] >= 0) {
      reference = (1 - node.weight) * at(node.parents[0]) + node.weight * at(node.parents[1]);
    }
    reference_.push_back(reference);
  }
}

void Monitor::topologyRestored() {
  particles_.resize(chosen_);
  reference_.resize(std::min(reference_.size(), chosen_));
}

void Monitor::takeReference(const StepContext& step) {
  // half a step of grace: times are sums of steps
  if (!reference_.empty() || step.time < since - 0.5 * step.dt) return;
  for (const Index i : particles_) {
    reference_.push_back(mechanicalState->x()[static_cast<std::size_t>(i)]);
  }
}

Vec3 Monitor::displacementOf(std::size_t k) const {
  const auto i = static_cast<std::size_t>(particles_[k]);
  if (!since.isSet()) return mechanicalState->x()[i] - mechanicalState->rest()[i];
  return reference_.empty() ? Vec3(Vec3::Zero()) : Vec3(mechanicalState->x()[i] - reference_[k]);
}

Monitor::Samples Monitor::sampleAttribute() const {
  const AttributeBase* source = attribute.source();
  if (const auto number = source->number()) return {1, {*number}};
  if (const auto* v = dynamic_cast<const Attribute<Vec3>*>(source)) {
    return {3, {(*v)->begin(), (*v)->end()}};
  }
  if (const auto* list = dynamic_cast<const Attribute<std::vector<double>>*>(source)) {
    return {1, **list};
  }
  if (const auto* list = dynamic_cast<const Attribute<std::vector<Vec3>>*>(source)) {
    const auto column = flat(ConstVec3Span(**list));
    return {3, {column.begin(), column.end()}};
  }
  return {0, {}};
}

Monitor::Samples Monitor::sampleEnergy() const {
  System* system = scene().systemOf(*mechanicalState);
  if (!system) return {1, {0.0}};
  if (quantity == Quantity::kineticEnergy) return {1, {system->kineticEnergy(system->v())}};
  return {1, {system->potentialEnergy({system->x(), system->v(), scene().time()})}};
}

Monitor::Samples Monitor::sample() const {
  if (attribute.isSet()) return sampleAttribute();
  if (quantity == Quantity::kineticEnergy || quantity == Quantity::potentialEnergy) {
    return sampleEnergy();
  }
  const MechanicalState& state = *mechanicalState;
  Samples samples{3, {}};
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const auto i = static_cast<std::size_t>(particles_[k]);
    Vec3 value = Vec3::Zero();
    switch (*quantity) {
      case Quantity::displacement:
        value = displacementOf(k);
        break;
      case Quantity::position:
        value = state.x()[i];
        break;
      case Quantity::velocity:
        value = state.v()[i];
        break;
      case Quantity::force:
        value = state.f()[i];
        break;
      case Quantity::reaction:
        value = -state.f()[i];
        break;
      default:
        break;
    }
    samples.values.insert(samples.values.end(), value.begin(), value.end());
  }
  return samples;
}

std::vector<std::pair<std::string, double>> Monitor::lastValues() const {
  std::vector<std::pair<std::string, double>> columns;
  if (!started_) return columns;
  const Samples samples = sample();
  const auto width = static_cast<std::size_t>(samples.components);
  const std::size_t count = width ? samples.values.size() / width : 0;
  const auto partsOf = [&](std::size_t i) {
    if (width == 1) return decltype(columns){{"", samples.values[i]}};
    return parts({samples.values[3 * i], samples.values[3 * i + 1], samples.values[3 * i + 2]},
                 component);
  };
  for (std::size_t i = 0; i < count && (reduce == Reduction::each || reduce == Reduction::max);
       ++i) {
    const auto values = partsOf(i);
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (reduce == Reduction::each) {
        const std::size_t label =
            i < particles_.size() ? static_cast<std::size_t>(particles_[i]) : i;
        const std::string suffix = count > 1 ? "[" + std::to_string(label) + "]" : "";
        columns.emplace_back(name() + suffix + values[c].first, values[c].second);
      } else if (i == 0) {
        columns.emplace_back(name() + values[c].first, values[c].second);
      } else {
        columns[c].second = larger(columns[c].second, values[c].second);
      }
    }
  }
  if (count == 0 || reduce == Reduction::each || reduce == Reduction::max) return columns;
  Vec3 total = Vec3::Zero();
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    total[static_cast<Eigen::Index>(i % width)] += samples.values[i];
  }
  if (reduce == Reduction::mean) total /= static_cast<double>(count);
  if (width == 1) return {{name(), total.x()}};
  for (const auto& [ending, value] : parts(total, component)) {
    columns.emplace_back(name() + ending, value);
  }
  return columns;
}

std::string Monitor::unit() const {
  if (attribute.isSet()) return std::string(attribute.source()->info().unit);
  switch (*quantity) {
    case Quantity::displacement:
    case Quantity::position:
      return "m";
    case Quantity::velocity:
      return "m/s";
    case Quantity::force:
    case Quantity::reaction:
      return "N";
    case Quantity::kineticEnergy:
    case Quantity::potentialEnergy:
      return "J";
  }
  return "";
}

void Monitor::open() {
  const std::filesystem::path file = outputFile(".csv");
  const std::string ending = unit().empty() ? "" : " (" + unit() + ")";
  std::string table = "step,time (s)";
  for (const auto& [column, value] : lastValues()) table += "," + column + ending;
  table += "\n";
  if (resumedAt_) {
    std::ifstream old(file);
    for (std::string row; std::getline(old, row);) {
      // without its end the last row may be cut short
      const auto step = stepOf(row);
      if (step && *step <= *resumedAt_ && !old.eof()) table += row + "\n";
    }
  }
  replaceFile(file, table);
  if (writes()) out_.open(file, std::ios::binary | std::ios::app);
}

void Monitor::record(double time, std::uint64_t step) {
  if (!out_.is_open()) open();
  if (!writes()) return;
  std::string row = std::to_string(step) + "," + text(time);
  for (const auto& [column, value] : lastValues()) row += "," + text(value);
  out_ << row << '\n' << std::flush;
  if (!out_) fail("cannot write '" + outputFile(".csv").string() + "'");
}

void Monitor::reset() {
  Recorder::reset();
  out_.close();
  resumedAt_.reset();
  reference_.clear();
}

void Monitor::stop() {
  Recorder::stop();
  out_.close();
}

void Monitor::save(StateWriter& writer) const {
  writer.write("reference", ConstVec3Span(reference_));
}

void Monitor::restore(StateReader& reader) {
  reference_.resize(reader.count<double>("reference") / 3);
  if (!reader.read("reference", Vec3Span(reference_))) reference_.clear();
  out_.close();
  resumedAt_ = scene().stepCount();
  setLastStep(resumedAt_);
}

}  // namespace stroma
