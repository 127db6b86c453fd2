// SPDX-License-Identifier: Apache-2.0
// Any text is either a study, with every combination of what it names, or a list of errors.
#include <cstdint>
#include <cstdlib>

#include "tools/study/plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stroma;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data), size);
  // what is included would be a file of this machine
  if (text.find("include") != std::string::npos) return 0;
  const study::Study study = study::readStudyText(text, "fuzzed.xml", diagnostics);
  if (diagnostics.text().size() > 2'000'000) std::abort();
  (void)diagnostics.json();
  if (diagnostics.errorCount() > 0) return 0;
  for (const study::Question& question : study.questions) {
    double count = 1;
    for (const study::Axis& axis : question.axes) count *= static_cast<double>(axis.points.size());
    if (count > 1e4) continue;
    for (const study::Variation& v : study::combinations(question, 0)) (void)study::labelOf(v);
  }
  return 0;
}
