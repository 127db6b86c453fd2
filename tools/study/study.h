// SPDX-License-Identifier: Apache-2.0
// What a study file says: questions, each with the variations of a scene that are run, what is
// measured of each, and what the measures are compared with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene_text.h"
#include "core/types.h"
#include "tools/study/quantity.h"

namespace stroma::study {

// One change of a scene.
struct Edit {
  enum class Kind { set, replace, remove, insert };
  Kind kind = Kind::set;
  std::string target;  // path of an element, of an attribute for `set`
  std::string value;   // of `set`
  SourceRange targetAt, valueAt;
  std::vector<std::string> methods;    // it is made only for those that fit() one; empty = for all
  std::vector<SceneElement> elements;  // what replaces the target, or is inserted into it
};

// A method, a point of an axis, or a reference run: edits, of the question's scene or another one.
struct Choice {
  std::string name{};
  SourceRange at{};
  std::string scene{};  // empty = the question's
  SourceRange sceneAt{};
  std::optional<Quantity> h{};  // of an element or a time step, for the order of convergence
  std::vector<Edit> edits{};
};

struct Axis {
  std::string name;
  SourceRange at;
  std::vector<Choice> points;
};

struct Measure {
  enum class Kind { monitor, attribute, field, energy, volume, reaction };
  enum class Norm { l2, max };
  std::string name;
  SourceRange at;
  Kind kind = Kind::monitor;
  std::string path;  // of the monitor, the attribute, the state, or the constraint
  SourceRange pathAt;
  std::string column;    // of a monitor with several values
  std::size_t axis = 0;  // of a reaction: 0 its size, 1 to 3 its part along x, y or z
  std::string topology;  // of a volume: whose triangles close it
  SourceRange topologyAt;
  std::vector<Vec3> points;  // of a field (m, rest positions)
  SourceRange pointsAt;
  Norm norm = Norm::l2;
  // What it is compared with: a number, for a field displacements (m), one a point, a reference
  // run, or nothing. Errors are relative to the scale instead of the reference, where given.
  std::optional<Quantity> reference, scale;
  SourceRange referenceAt, scaleAt;
  std::vector<Vec3> referenceField;
  std::string referenceRun;
  std::string source;  // where the reference comes from
  // Taken only of methods and reference runs that fit() one; empty = of all. So methods with other
  // components can have the same measure.
  std::vector<std::string> methods;
};

// Combinations that are left out: those whose names fit() one in every one of the lists.
struct Skip {
  std::vector<std::pair<std::string, std::vector<std::string>>> where;  // "method" or an axis
};

// A figure from elsewhere, shown beside ours.
struct Published {
  std::string name, source;
  std::string method;  // of ours that it is set against; the first one if empty
  double ms = 0;
  std::optional<double> error;
};

struct Question {
  std::string name, text;
  SourceRange at;
  std::string scene;
  SourceRange sceneAt;
  std::optional<double> time;  // s, simulated; else steps; else the scene's duration
  std::uint64_t steps = 0;
  bool costOfRun = false;   // the cost is that of the whole run instead of a step
  std::vector<Edit> edits;  // made first, for all variations and reference runs
  std::vector<Measure> measures;
  std::vector<Choice> references;
  std::vector<Axis> axes;
  std::vector<Choice> methods;
  std::vector<Skip> skips;
  std::vector<Published> published;
  std::vector<double> errorBudgets, msBudgets;
};

struct Study {
  std::string file, title, cite, text;
  int repeats = 5;         // runs of each variation, the first one (warm-up) included
  double timeBudget = 20;  // s; no further repeat is begun after that
  double timeout = 600;    // s for a variation, with its repeats
  int threads = 1;
  std::vector<Question> questions;
};

// Reads a study. Every problem is reported with its place and, where a name is near, a hint; the
// result is to be used only if there were no errors.
[[nodiscard]] Study readStudy(const std::filesystem::path& file, Diagnostics& diagnostics);
// The same for text; `file` names it in messages.
[[nodiscard]] Study readStudyText(std::string text, const std::filesystem::path& file,
                                  Diagnostics& diagnostics);

}  // namespace stroma::study
