// SPDX-License-Identifier: Apache-2.0
#include "tools/study/job.h"

#include <unistd.h>

#include <fstream>
#include <iterator>

namespace stroma::study {
namespace fs = std::filesystem;
namespace {

Json toJson(const Measure& measure) {
  Json json{{"name", measure.name}, {"kind", static_cast<int>(measure.kind)},
            {"path", measure.path}, {"column", measure.column},
            {"axis", measure.axis}, {"topology", measure.topology}};
  Json points = Json::array();
  for (const Vec3& p : measure.points) points.push_back({p.x(), p.y(), p.z()});
  json["points"] = std::move(points);
  return json;
}

Measure measureFrom(const Json& json) {
  Measure measure;
  measure.name = json.at("name");
  measure.kind = static_cast<Measure::Kind>(json.at("kind").get<int>());
  measure.path = json.at("path");
  measure.column = json.at("column");
  measure.axis = json.at("axis");
  measure.topology = json.at("topology");
  for (const Json& p : json.at("points")) measure.points.emplace_back(p.at(0), p.at(1), p.at(2));
  return measure;
}

Json deciding(const Job& job) {
  Json measures = Json::array();
  for (const Measure& measure : job.measures) measures.push_back(toJson(measure));
  return {{"overrides", job.overrides},
          {"time", job.time ? Json(*job.time) : Json()},
          {"steps", job.steps},
          {"repeats", job.repeats},
          {"threads", job.threads},
          {"time_budget", job.timeBudget},
          {"measures", std::move(measures)}};
}

}  // namespace

std::string identityOf(const Job& job) { return deciding(job).dump(); }

Json toJson(const Job& job) {
  Json json = deciding(job);
  json["id"] = job.id;
  json["label"] = job.label;
  json["scene"] = job.scene;
  json["base"] = job.base;
  json["plugins"] = job.plugins;
  json["data"] = job.data;
  json["timeout"] = job.timeout;
  json["result"] = job.result;
  json["side_by_side"] = job.sideBySide;
  return json;
}

Job jobFrom(const Json& json) {
  Job job;
  job.id = json.at("id");
  job.label = json.at("label");
  job.scene = json.at("scene");
  job.base = json.at("base");
  job.overrides = json.at("overrides").get<std::vector<std::string>>();
  job.plugins = json.at("plugins").get<std::vector<std::string>>();
  job.data = json.at("data").get<std::vector<std::string>>();
  if (!json.at("time").is_null()) job.time = json.at("time").get<double>();
  job.steps = json.at("steps");
  job.repeats = json.at("repeats");
  job.threads = json.at("threads");
  job.timeBudget = json.at("time_budget");
  job.timeout = json.at("timeout");
  for (const Json& measure : json.at("measures")) job.measures.push_back(measureFrom(measure));
  job.result = json.at("result");
  job.sideBySide = json.at("side_by_side");
  return job;
}

std::optional<std::string> readFile(const fs::path& file) {
  std::error_code failure;
  if (!fs::is_regular_file(file, failure)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) return std::nullopt;
  return text;
}

Json readJson(const fs::path& file) {
  const auto text = readFile(file);
  if (!text) return nullptr;
  Json json = Json::parse(*text, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

bool replaceFile(const fs::path& file, std::string_view bytes) {
  const fs::path part = file.string() + ".part" + std::to_string(getpid());
  std::error_code failure;
  std::ofstream stream(part, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) fs::rename(part, file, failure);
  if (!stream || failure) {
    std::error_code ignored;
    fs::remove(part, ignored);
    return false;
  }
  return true;
}

}  // namespace stroma::study
