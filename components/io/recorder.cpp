// SPDX-License-Identifier: Apache-2.0
#include "components/io/recorder.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {

void Recorder::configure() {
  const std::filesystem::path path = filename->path;
  const bool climbs = std::ranges::find(path, std::filesystem::path("..")) != path.end();
  if (path.is_absolute() || climbs) {
    error(filename, "output-path", "leaves the output folder",
          "give a relative path; the command line chooses the folder");
  }
  forEachComponent(scene().root(), [&](Component& c) {
    const auto* other = dynamic_cast<const Recorder*>(&c);
    if (other && other != this && other->type() == type() &&
        other->outputFile("") == outputFile("") && !other->failed()) {
      error(filename, "output-twice", "would be written by '" + other->path() + "', too",
            "give each its own name");
    }
  });
  if (everySteps.isSet() && period > 0) {
    error(period, "attr-conflict", "and 'exportEveryNumberOfSteps' cannot both be given");
  }
  if (everySteps == 0 && period <= 0 && !atBegin && !atEnd) {
    warning("export-never", "writes nothing",
            "give 'exportEveryNumberOfSteps', 'period', 'exportAtBegin' or 'exportAtEnd'");
  }
}

void Recorder::schedule(Schedule& schedule) {
  // at the first step's beginning mapped states are up to date, in start() they are not
  if (atBegin) schedule.add<&Recorder::begin>(Stage::Input, *this, "first frame");
  if (everySteps > 0 || period > 0) {
    schedule.add<&Recorder::publish>(Stage::Publish, *this, "record");
  }
}

void Recorder::begin(const StepContext& step) {
  if (step.step == 1) recordOnce(step.time, 0);
}

void Recorder::publish(const StepContext& step) {
  if (period <= 0) {
    if (step.step % static_cast<std::uint64_t>(*everySteps) == 0) recordOnce(step.time, step.step);
    return;
  }
  const auto periods = [&](std::uint64_t steps) {
    return std::floor(static_cast<double>(steps) * step.dt / period + 1e-9);
  };
  if (periods(step.step) > periods(step.step - 1)) recordOnce(step.time, step.step);
}

void Recorder::stop() {
  if (atBegin && scene().stepCount() == 0) recordOnce(scene().time(), 0);
  if (atEnd) recordOnce(scene().time(), scene().stepCount());
}

void Recorder::reset() { lastStep_.reset(); }

void Recorder::recordOnce(double time, std::uint64_t step) {
  if (lastStep_ == step || !writes()) return;
  lastStep_ = step;
  record(time, step);
}

bool Recorder::writes() const { return scene().options().writesOutput && trouble_.empty(); }

std::filesystem::path Recorder::outputFile(const std::string& extension) const {
  std::filesystem::path file = filename->path.empty() ? name() : filename->path;
  if (file.extension() == extension) file.replace_extension();
  file += extension;
  return scene().options().outputFolder / file;
}

void Recorder::replaceFile(const std::filesystem::path& file, std::string_view bytes) {
  if (!writes()) return;
  std::error_code failure;
  std::filesystem::create_directories(file.parent_path(), failure);
  std::filesystem::path part = file;
  part += ".part";
  errno = 0;
  {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) return fail("cannot write '" + part.string() + "': " + std::strerror(errno));
  }
  std::filesystem::rename(part, file, failure);
  if (failure) return fail("cannot write '" + file.string() + "': " + failure.message());
  addFile(file);
}

void Recorder::fail(std::string reason) {
  if (!trouble_.empty()) return;
  trouble_ = std::move(reason);
  error("output", trouble_);
}

void Recorder::checkFollows(const TopologyChange& change, const MechanicalState& nodes,
                            const Mesh* elements) {
  const bool ownNodes = &change.nodes == &nodes, ownElements = &change.surface == elements;
  if (ownElements && !ownNodes) {
    fail("'" + change.surface.path() + "' has been cut: its elements have nodes that '" +
         nodes.path() + "' lacks");
  } else if (ownNodes && elements && !ownElements && !warnedOfCut_) {
    warnedOfCut_ = true;
    warning("export-uncut", "writes the elements of '" + elements->path() + "', but it is '" +
                                change.surface.path() + "' that has been cut");
  }
}

void Recorder::addFile(const std::filesystem::path& file) {
  if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
}

}  // namespace stroma
