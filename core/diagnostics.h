// SPDX-License-Identifier: Apache-2.0
// Problems are collected, not thrown or printed: a reader reports all it finds in one pass, and the
// application decides how to show them. Output is bounded and printable whatever the input was.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/source.h"

namespace stroma {

enum class Severity { error, warning, note };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string id;       // short kind, such as "attr-unknown"
  std::string message;  // one line
  SourceRange where;
  std::string hint;  // what to do about it; may be empty or have several lines
};

class Diagnostics {
 public:
  // Of each severity so many are kept; the others are only counted.
  static constexpr int mostKept = 200;

  void report(Diagnostic diagnostic);
  void error(std::string id, std::string message, SourceRange where = {}, std::string hint = {});
  void warning(std::string id, std::string message, SourceRange where = {}, std::string hint = {});
  void note(std::string id, std::string message, SourceRange where = {}, std::string hint = {});

  // Counts include those that were not kept.
  [[nodiscard]] int errorCount() const { return count(Severity::error); }
  [[nodiscard]] int warningCount() const { return count(Severity::warning); }

  // The kept ones, in the order in which they were reported.
  [[nodiscard]] std::span<const Diagnostic> all() const { return kept_; }

  // All that are kept, with excerpts, ordered by file (as first seen), line and column; then how
  // many were left out, and where there are errors the line
  // "2 errors, 0 warnings; nothing was started."
  [[nodiscard]] std::string text() const;

  // One object: errors, warnings, omitted, and the list "diagnostics", in the order of text(), each
  // with its place and the excerpt that text() shows.
  [[nodiscard]] std::string json() const;

 private:
  [[nodiscard]] int count(Severity severity) const {
    return counts_[static_cast<std::size_t>(severity)];
  }
  [[nodiscard]] int omitted() const;
  [[nodiscard]] std::vector<const Diagnostic*> inOrder() const;

  std::vector<Diagnostic> kept_;
  std::array<int, 3> counts_{};
};

// The lines for one problem, ending with a newline:
//   scene.xml:14:46: error: MLSForceField 'fem': unknown attribute 'yougModulus'  [attr-unknown]
//      14 |     <MLSForceField name="fem" support="4 mm" yougModulus="3000"/>
//         |                                              ^~~~~~~~~~~
//         = did you mean 'youngModulus'?
[[nodiscard]] std::string format(const Diagnostic& diagnostic);

// The text in single quotes, with control characters and broken UTF-8 escaped, shortened to `most`
// characters: safe to put into a message whatever a file contained.
[[nodiscard]] std::string quoted(std::string_view text, std::size_t most = 60);

// The candidates that somebody who wrote `wrong` may have meant, best first: few edits away
// (insertion, deletion, substitution, swap of neighbours: Damerau 1964, Levenshtein 1966),
// upper and lower case being the same. Words of over 64 bytes have no neighbours.
[[nodiscard]] std::vector<std::string> nearestNames(std::string_view wrong,
                                                    std::span<const std::string> candidates,
                                                    std::size_t most = 3);

// "did you mean 'x'?" for the nearest name, or "" where none is near.
[[nodiscard]] std::string didYouMean(std::string_view wrong,
                                     std::span<const std::string> candidates);

}  // namespace stroma
