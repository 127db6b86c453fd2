// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "tools/study/results.h"

namespace stroma::study {
namespace {

// A number as JSON has it, text in quotes where CSV (RFC 4180) wants them.
std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value;
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '"');
  }
  return "\"" + text + "\"";
}

std::string pointsOf(const Json& row) {
  std::string text;
  for (const auto& [axis, point] : row["points"].items()) {
    text += (text.empty() ? "" : "; ") + axis + " " + point.get<std::string>();
  }
  return text;
}

std::string rounded(const Json& number, double factor = 1) {
  if (number.is_null()) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", factor * number.get<double>());
  return text;
}

std::vector<std::string> measureNames(const Json& summary) {
  std::vector<std::string> names;
  for (const Json& question : summary["questions"]) {
    for (const Json& measure : question["measures"]) {
      const std::string name = measure["name"];
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace

std::string csvOf(const Json& summary) {
  const std::vector<std::string> measures = measureNames(summary);
  const std::vector<std::string> times{"median", "min", "max", "p99", "runs"};
  const std::vector<std::string> plain{"first_run_ms_per_step",
                                       "wall_ms_per_step",
                                       "real_time_factor",
                                       "steps",
                                       "dt",
                                       "particles",
                                       "threads",
                                       "load_ms",
                                       "peak_memory_mb",
                                       "repeats_agree",
                                       "side_by_side",
                                       "state_hash"};
  std::string csv = "question,method,point,h,status,message,error,cost_ms";
  for (const std::string& name : times) csv += ",ms_per_step_" + name;
  for (const std::string& name : plain) csv += "," + name;
  for (const std::string& name : measures) {
    csv += "," + cell(name + " value") + "," + cell(name + " error");
  }
  csv += "\n";
  for (const Json& question : summary["questions"]) {
    for (const Json& row : question["rows"]) {
      const Json none = Json::object();
      const Json& ms = row.contains("ms_per_step") ? row["ms_per_step"] : none;
      csv += cell(question["name"]) + "," + cell(row["method"]) + "," + cell(pointsOf(row)) + "," +
             cell(row["h"]) + "," + cell(row["status"]) + "," + cell(row["message"]) + "," +
             cell(row.value("error", Json())) + "," + cell(row.value("cost_ms", Json()));
      for (const std::string& name : times) csv += "," + cell(ms.value(name, Json()));
      for (const std::string& name : plain) csv += "," + cell(row.value(name, Json()));
      const Json& values = row.contains("values") ? row["values"] : none;
      for (const std::string& name : measures) {
        const Json value = values.value(name, none);
        csv += "," + cell(value.value("value", Json())) + "," + cell(value.value("error", Json()));
      }
      csv += "\n";
    }
  }
  return csv;
}

std::string textOf(const Json& summary) {
  std::string text = summary["title"].get<std::string>() + "\n";
  for (const Json& question : summary["questions"]) {
    const std::string name = question["name"];
    text += "\n" + (name.empty() ? "" : name + "\n");
    std::size_t width = 9;
    for (const Json& row : question["rows"]) {
      width = std::max(width, row["label"].get<std::string>().size());
    }
    const std::string cost = question["cost"] == "run" ? "ms a run" : "ms a step";
    char line[400];
    std::snprintf(line, sizeof line, "  %-*s  %10s  %10s  %10s\n", static_cast<int>(width),
                  "variation", "error in %", cost.c_str(), "real time");
    text += line;
    for (const Json& row : question["rows"]) {
      text += "  " + row["label"].get<std::string>() +
              std::string(width - row["label"].get<std::string>().size(), ' ');
      if (row["status"] == "done") {
        std::snprintf(line, sizeof line, "  %10s  %10s  %10s\n",
                      rounded(row.value("error", Json()), 100).c_str(),
                      rounded(row["cost_ms"]).c_str(),
                      rounded(row.value("real_time_factor", Json())).c_str());
        text += line;
      } else {
        text += "  " + row["status"].get<std::string>() + " " + row["message"].get<std::string>() +
                "\n";
      }
    }
    for (const Json& sentence : question["sentences"]) {
      text += "  " + sentence.get<std::string>() + "\n";
    }
  }
  return text;
}

}  // namespace stroma::study
