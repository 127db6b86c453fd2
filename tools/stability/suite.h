// SPDX-License-Identifier: Apache-2.0
// What a suite of hard cases says: scenes with criteria, and the methods that each of them is run
// with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/study/study.h"

namespace stroma::stability {

// A force field with a solver: edits of every case's scene. Inside what replaces an element,
// "{name}" stands for that attribute of the element replaced; where that has none, the attribute is
// left out.
struct Method {
  std::string name, text;
  SourceRange at;
  bool quick = false;      // belongs to the quick part
  bool isDefault = false;  // the cases are promised for it; others are there to compare
  std::vector<study::Edit> edits;
};

// Methods that a case cannot be run with, and why.
struct NotApplicable {
  std::vector<std::string> methods;  // fits() one of them
  std::string reason;
};

struct Case {
  std::string name, scene, text;
  SourceRange at, sceneAt;
  bool isLong = false;             // not in the quick part
  double timeout = 60;             // s, of a run
  std::vector<study::Edit> edits;  // made after those of the method
  std::vector<NotApplicable> notApplicable;
};

// A case that other tests hold.
struct HeldElsewhere {
  std::string name, test, text;
};

struct Suite {
  std::string file, title, text;
  std::vector<Method> methods;
  std::vector<Case> cases;
  std::vector<HeldElsewhere> elsewhere;
};

// Reads a suite. Every problem is reported with its place; the result is to be used only if there
// were no errors.
[[nodiscard]] Suite readSuite(const std::filesystem::path& file, Diagnostics& diagnostics);
// The same for text; `file` names it in messages.
[[nodiscard]] Suite readSuiteText(std::string text, const std::filesystem::path& file,
                                  Diagnostics& diagnostics);

}  // namespace stroma::stability
