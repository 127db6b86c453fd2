// SPDX-License-Identifier: Apache-2.0
#include "tools/stability/suite_results.h"

#include <algorithm>

namespace stroma::stability {
namespace {

using study::Json;

Json cellOf(const Suite& suite, const Cell& cell, const Results& results) {
  Json out = {{"method", suite.methods[cell.method].name},
              {"default", suite.methods[cell.method].isDefault}};
  if (!cell.notApplicable.empty()) {
    out["state"] = "not applicable";
    out["why"] = cell.notApplicable;
    return out;
  }
  const auto found = results.find(cell.job.id);
  if (cell.skipped || found == results.end()) {
    out["state"] = "not run";
    return out;
  }
  const Json& result = found->second;
  const std::string status = result.value("status", "crashed");
  out["state"] = status == "passed" ? "passed" : "failed";
  const std::string message = result.value("message", "");
  out["why"] = status == "passed" || status == "failed" ? message : status + ": " + message;
  for (const auto& [key, value] : result.items()) {
    if (key != "picture" && key != "label" && key != "message") out[key] = value;
  }
  return out;
}

std::string stateOf(const Json& cells) {
  bool ran = false;
  for (const Json& cell : cells) {
    if (!cell["default"].get<bool>()) continue;
    if (cell["state"] == "failed") return "failed";
    ran = ran || cell["state"] == "passed";
  }
  return ran ? "passed" : "not run";
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string sign(const std::string& state) {
  if (state == "passed") return "ok";
  if (state == "failed") return "FAIL";
  return state == "not applicable" ? "n/a" : "-";
}

// Methods have numbers in the table's head: their names are too long for columns.
std::string tableOf(const Json& summary) {
  std::string text;
  std::size_t width = 4;
  for (const Json& one : summary["cases"]) {
    width = std::max(width, one["name"].get<std::string>().size());
  }
  int number = 0;
  for (const Json& method : summary["methods"]) {
    text += padded(std::to_string(++number), 4) + method["name"].get<std::string>() +
            (method["default"].get<bool>() ? " (default)" : "") + "\n";
  }
  text += "\n" + padded("case", width + 2);
  for (int k = 1; k <= number; ++k) text += padded(std::to_string(k), 5);
  text += "\n";
  for (const Json& one : summary["cases"]) {
    text += padded(one["name"].get<std::string>(), width + 2);
    for (const Json& cell : one["cells"]) {
      text += padded(sign(cell["state"].get<std::string>()), 5);
    }
    text += "\n";
  }
  return text;
}

std::string failuresOf(const Json& summary, bool defaults) {
  std::string text;
  for (const Json& one : summary["cases"]) {
    for (const Json& cell : one["cells"]) {
      if (cell["state"] != "failed") continue;
      if (cell["default"].get<bool>() != defaults) continue;
      text += "FAIL  " + one["name"].get<std::string>() + ", " + cell["method"].get<std::string>() +
              ": " + cell["why"].get<std::string>() + "\n";
    }
  }
  const char* title = defaults ? "\nwhat failed\n" : "\nwhat failed with methods compared\n";
  return text.empty() ? "" : title + text;
}

std::string limitersOf(const Json& summary) {
  std::string text;
  for (const Json& one : summary["cases"]) {
    for (const Json& cell : one["cells"]) {
      if (!cell.contains("limiters") || cell["limiters"].empty()) continue;
      std::string list;
      for (const auto& [name, count] : cell["limiters"].items()) {
        list += (list.empty() ? "" : ", ") + name + " " + std::to_string(count.get<long>());
      }
      text += "  " + one["name"].get<std::string>() + ", " + cell["method"].get<std::string>() +
              ": " + list + "\n";
    }
  }
  return text.empty() ? "" : "\nlimiters that acted, and how often\n" + text;
}

std::string reasonsOf(const Json& summary) {
  std::string text;
  for (const Json& one : summary["cases"]) {
    std::map<std::string, std::string> methods;  // by reason
    std::vector<std::string> order;
    for (const Json& cell : one["cells"]) {
      if (cell["state"] != "not applicable") continue;
      const auto why = cell["why"].get<std::string>();
      std::string& list = methods[why];
      if (list.empty()) order.push_back(why);
      list += (list.empty() ? "" : ", ") + cell["method"].get<std::string>();
    }
    for (const std::string& why : order) {
      text += "  " + one["name"].get<std::string>() + ", " + methods[why] + ": " + why + "\n";
    }
  }
  return text.empty() ? "" : "\nnot applicable (n/a)\n" + text;
}

}  // namespace

Json summarise(const Suite& suite, const std::vector<Cell>& cells, const Results& results,
               const Json& machine) {
  Json methods = Json::array(), cases = Json::array(), elsewhere = Json::array();
  for (const Method& m : suite.methods)
    methods.push_back({{"name", m.name}, {"text", m.text}, {"default", m.isDefault}});
  for (const Case& one : suite.cases) {
    cases.push_back(
        {{"name", one.name}, {"text", one.text}, {"scene", one.scene}, {"cells", Json::array()}});
  }
  for (const Cell& cell : cells) {
    cases[cell.caseNumber]["cells"].push_back(cellOf(suite, cell, results));
  }
  std::size_t passed = 0, failed = 0, compared = 0, comparedPassed = 0;
  for (Json& one : cases) {
    for (const Json& cell : one["cells"]) {
      if (cell["default"].get<bool>()) continue;
      compared += cell["state"] == "passed" || cell["state"] == "failed" ? 1 : 0;
      comparedPassed += cell["state"] == "passed" ? 1 : 0;
    }
    const std::string state = stateOf(one["cells"]);
    one["state"] = state;
    passed += state == "passed" ? 1 : 0;
    failed += state == "failed" ? 1 : 0;
  }
  for (const HeldElsewhere& e : suite.elsewhere) {
    elsewhere.push_back({{"name", e.name}, {"test", e.test}, {"text", e.text}});
  }
  return {{"format", "stroma-stability 1"},
          {"title", suite.title},
          {"text", suite.text},
          {"file", suite.file},
          {"machine", machine},
          {"methods", std::move(methods)},
          {"cases", std::move(cases)},
          {"elsewhere", std::move(elsewhere)},
          {"totals",
           {{"cases", passed + failed},
            {"passed", passed},
            {"failed", failed},
            {"runs", results.size()},
            {"compared", compared},
            {"compared_passed", comparedPassed}}}};
}

std::string textOf(const Json& summary) {
  std::string text = summary["title"].get<std::string>() + "\n\n" + tableOf(summary) +
                     reasonsOf(summary) + limitersOf(summary);
  if (!summary["elsewhere"].empty()) text += "\nheld by other tests\n";
  for (const Json& e : summary["elsewhere"]) {
    text += "  " + e["name"].get<std::string>() + ": " + e["test"].get<std::string>() + "\n";
  }
  const auto count = [&](const char* key) {
    return std::to_string(summary["totals"][key].get<std::size_t>());
  };
  text += failuresOf(summary, false) + failuresOf(summary, true) + "\n";
  if (count("compared") != "0") {
    text += "methods compared: " + count("compared_passed") + " of " + count("compared") +
            " runs passed\n";
  }
  return text + count("cases") + " cases: " + count("passed") + " passed, " + count("failed") +
         " failed\n";
}

}  // namespace stroma::stability
