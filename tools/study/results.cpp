// SPDX-License-Identifier: Apache-2.0
#include "tools/study/results.h"

#include <algorithm>
#include <cmath>

#include "tools/study/analysis.h"
#include "tools/study/names.h"

namespace stroma::study {
namespace {

// Relative difference of two fields at common points, over the reference's own size.
double fieldError(const Json& field, const Json& reference, Measure::Norm norm) {
  double difference2 = 0, size2 = 0, difference = 0, size = 0;
  for (std::size_t i = 0; i + 2 < field.size() && field.size() == reference.size(); i += 3) {
    const auto at = [i](const Json& f) {
      return Vec3(f[i].get<double>(), f[i + 1].get<double>(), f[i + 2].get<double>());
    };
    const Vec3 wanted = at(reference), off = at(field) - wanted;
    difference2 += off.squaredNorm();
    size2 += wanted.squaredNorm();
    difference = std::max(difference, off.norm());
    size = std::max(size, wanted.norm());
  }
  return norm == Measure::Norm::l2 ? std::sqrt(difference2 / size2) : difference / size;
}

Json flat(const std::vector<Vec3>& vectors) {
  Json numbers = Json::array();
  for (const Vec3& v : vectors) {
    for (const double part : v) numbers.push_back(part);
  }
  return numbers;
}

Json finiteOrNull(double number) { return std::isfinite(number) ? Json(number) : Json(); }

class Summary {
 public:
  Summary(const Study& study, const std::vector<Variation>& plan, const Results& results)
      : study_(study), plan_(plan), results_(results) {}

  Json question(std::size_t number) {
    const Question& question = study_.questions[number];
    Json json{{"name", question.name},
              {"text", question.text},
              {"scene", question.scene},
              {"cost", question.costOfRun ? "run" : "step"}};
    json["measures"] = describeMeasures(question);
    json["axes"] = Json::array();
    for (const Axis& axis : question.axes) json["axes"].push_back(axis.name);
    json["methods"] = Json::array();
    for (const Choice& method : question.methods) json["methods"].push_back(method.name);
    json["budgets"] = {{"error", question.errorBudgets}, {"ms", question.msBudgets}};
    json["published"] = Json::array();
    for (const Published& p : question.published) {
      json["published"].push_back({{"name", p.name},
                                   {"ms", p.ms},
                                   {"error", p.error ? Json(*p.error) : Json()},
                                   {"source", p.source}});
    }
    json["references"] = Json::array();
    json["rows"] = Json::array();
    for (const Variation& variation : plan_) {
      if (variation.question != number) continue;
      json[variation.isReference ? "references" : "rows"].push_back(row(question, variation));
    }
    conclude(question, json);
    return json;
  }

 private:
  static Json describeMeasures(const Question& question) {
    Json all = Json::array();
    for (const Measure& m : question.measures) {
      constexpr std::array<const char*, 6> kinds{"monitor", "attribute", "field",
                                                 "energy",  "volume",    "reaction"};
      Json one{{"name", m.name}, {"kind", kinds[static_cast<std::size_t>(m.kind)]}};
      if (m.kind == Measure::Kind::field) {
        one["norm"] = m.norm == Measure::Norm::l2 ? "l2" : "max";
      }
      one["reference"] = m.reference                ? Json(m.reference->value)
                         : !m.referenceRun.empty()  ? Json("@" + m.referenceRun)
                         : m.referenceField.empty() ? Json()
                                                    : Json("displacements");
      if (m.scale) one["scale"] = m.scale->value;
      one["source"] = m.source;
      one["methods"] = m.methods;
      const auto known =
          std::ranges::find_if(all, [&](const Json& other) { return other["name"] == m.name; });
      if (known == all.end()) {
        all.push_back(std::move(one));
      } else {  // the same question to methods that are compared with something else
        (*known)["others"].push_back(std::move(one));
      }
    }
    return all;
  }

  [[nodiscard]] const Json* resultOf(const Variation& variation) const {
    const auto found = results_.find(variation.job.id);
    return found == results_.end() ? nullptr : &found->second;
  }

  [[nodiscard]] Json row(const Question& question, const Variation& variation) const {
    Json row{{"id", variation.job.id}, {"method", variation.method}};
    row["points"] = Json::object();
    for (const auto& [axis, point] : variation.points) row["points"][axis] = point;
    row["label"] = labelOf(variation);
    row["h"] = variation.h ? Json(variation.h->value) : Json();
    const Json* result = resultOf(variation);
    row["status"] = result ? (*result)["status"] : Json("not run");
    row["message"] = result ? (*result)["message"] : Json("");
    if (!result || row["status"] != "done") return row;
    if (!variation.isReference) {
      row["values"] = Json::object();
      for (const Measure& m : question.measures) {
        if (isOf(m, variation.method)) row["values"][m.name] = compare(m, *result, variation);
      }
      const std::string& first = question.measures.front().name;
      row["error"] = row["values"].contains(first) ? row["values"][first]["error"] : Json();
    }
    const double ms = (*result)["ms_per_step"]["median"];
    row["cost_ms"] = question.costOfRun ? ms * (*result)["steps"].get<double>() : ms;
    for (const char* name :
         {"ms_per_step", "first_run_ms_per_step", "wall_ms_per_step", "real_time_factor", "steps",
          "dt", "particles", "threads", "load_ms", "peak_memory_mb", "stages", "limiters",
          "repeats_agree", "state_hash", "modules", "processor", "side_by_side"}) {
      if (result->contains(name)) row[name] = (*result)[name];
    }
    return row;
  }

  [[nodiscard]] static Json measuredIn(const Json& result, const std::string& name) {
    const auto all = result.find("measures");
    if (all != result.end() && all->contains(name)) return all->at(name);
    return {{"problem", "no measure '" + name +
                            "' was taken there: its 'method' leaves out what it is compared with"}};
  }

  // The measured value beside its reference.
  [[nodiscard]] Json compare(const Measure& measure, const Json& result,
                             const Variation& variation) const {
    const Json measured = measuredIn(result, measure.name);
    Json out{{"value", measured.value("value", Json())}, {"error", nullptr}};
    if (measured.contains("problem")) return out["problem"] = measured["problem"], out;
    Json reference;
    if (measure.reference) {
      reference = {{"value", measure.reference->value}};
    } else if (!measure.referenceField.empty()) {
      reference["field"] = flat(measure.referenceField);
    } else if (!measure.referenceRun.empty()) {
      reference = referenceValue(measure, variation.question);
      if (reference.contains("problem")) return out["problem"] = reference["problem"], out;
    } else {
      return out;
    }
    if (measure.kind == Measure::Kind::field) {
      out["error"] = finiteOrNull(fieldError(measured["field"], reference["field"], measure.norm));
      return out;
    }
    const double wanted = reference["value"];
    // minus is too little, whichever way the value points
    const double size = measure.scale ? std::copysign(measure.scale->value, wanted) : wanted;
    const double off = (measured["value"].get<double>() - wanted) / size;
    out["reference"] = wanted;
    out["error"] = finiteOrNull(std::abs(off));
    out["signed_error"] = finiteOrNull(off);
    return out;
  }

  [[nodiscard]] Json referenceValue(const Measure& measure, std::size_t question) const {
    for (const Variation& v : plan_) {
      if (!v.isReference || v.question != question || v.method != measure.referenceRun) continue;
      const Json* result = resultOf(v);
      if (!result) break;
      if ((*result)["status"] == "done") return measuredIn(*result, measure.name);
      return {{"problem", "the reference run '" + v.method + "' " +
                              (*result)["status"].get<std::string>() + ": " +
                              (*result)["message"].get<std::string>()}};
    }
    return {{"problem", "the reference run '" + measure.referenceRun + "' was not made"}};
  }

  static void conclude(const Question& question, Json& json) {
    std::vector<Point> points;
    std::vector<std::size_t> rows;
    std::vector<Point> timed;  // those without an error, too
    for (std::size_t i = 0; i < json["rows"].size(); ++i) {
      const Json& row = json["rows"][i];
      if (row.value("cost_ms", Json()).is_null()) continue;
      const Json& ms = row["ms_per_step"];
      const double steps = question.costOfRun ? row["steps"].get<double>() : 1;
      timed.push_back({row["method"], row["label"], row["cost_ms"], 0,
                       steps * ms["min"].get<double>(), steps * ms["max"].get<double>()});
      if (row.value("error", Json()).is_null()) continue;
      points.push_back(timed.back());
      points.back().error = row["error"];
      rows.push_back(i);
    }
    json["pareto"] = Json::array();
    for (const std::size_t p : paretoFront(points)) json["pareto"].push_back(rows[p]);
    json["series"] = seriesOf(question, json["rows"]);
    const std::string cost = question.costOfRun ? "ms for the run" : "ms a step";
    json["sentences"] = sentences(points, {question.errorBudgets, question.msBudgets, cost});
    if (points.empty()) json["sentences"] = {orderOfCosts(timed, cost)};
    const auto ended = std::ranges::count_if(
        json["rows"], [](const Json& row) { return row["status"] == "done"; });
    if (const auto all = std::ssize(json["rows"]); ended < all) {
      json["sentences"].push_back(std::to_string(all - ended) + " of " + std::to_string(all) +
                                  " variations gave no result: the table says why.");
    }
    for (const Json& reference : json["references"]) {
      if (reference["status"] == "done") continue;
      json["sentences"].push_back("The reference run " + reference["method"].get<std::string>() +
                                  " gave no result: " + reference["status"].get<std::string>() +
                                  " " + reference["message"].get<std::string>());
    }
    for (const Published& p : question.published) {
      const std::string& against = p.method.empty() ? question.methods.front().name : p.method;
      const auto ours =
          std::ranges::find_if(timed, [&](const Point& t) { return fits(against, t.method); });
      if (ours != timed.end()) json["sentences"].push_back(beside(p.name, p.ms, *ours));
    }
  }

  // Rows that differ in h only, each with its order of convergence.
  static Json seriesOf(const Question& question, const Json& rows) {
    const auto sized = std::ranges::find_if(question.axes, [](const Axis& axis) {
      return std::ranges::any_of(axis.points, [](const Choice& p) { return p.h.has_value(); });
    });
    Json series = Json::array();
    std::vector<std::vector<std::pair<double, double>>> pairs;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::string name = rows[i]["method"];
      for (const auto& [axis, point] : rows[i]["points"].items()) {
        if (sized == question.axes.end() || axis != sized->name) {
          name += ", " + axis + " " + point.get<std::string>();
        }
      }
      // without sizes a method is one series
      if (sized == question.axes.end()) name = rows[i]["method"];
      auto at = std::ranges::find_if(series, [&](const Json& s) { return s["name"] == name; });
      if (at == series.end()) {
        series.push_back({{"name", name}, {"method", rows[i]["method"]}, {"rows", Json::array()}});
        pairs.emplace_back();
        at = series.end() - 1;
      }
      (*at)["rows"].push_back(i);
      if (rows[i]["h"].is_null() || rows[i].value("error", Json()).is_null()) continue;
      pairs[static_cast<std::size_t>(at - series.begin())].emplace_back(rows[i]["h"],
                                                                        rows[i]["error"]);
    }
    for (std::size_t s = 0; s < series.size(); ++s) {
      const auto order = fitOrder(pairs[s]);
      series[s]["order"] = order ? Json(order->order) : Json();
    }
    return series;
  }

  const Study& study_;
  const std::vector<Variation>& plan_;
  const Results& results_;
};

}  // namespace

Json summarise(const Study& study, const std::vector<Variation>& plan, const Results& results,
               const Json& machine) {
  Json json{{"format", "stroma-study 1"}, {"title", study.title}, {"cite", study.cite},
            {"text", study.text},         {"file", study.file},   {"machine", machine}};
  json["complete"] =
      std::ranges::all_of(plan, [&](const Variation& v) { return results.contains(v.job.id); });
  json["questions"] = Json::array();
  Summary summary(study, plan, results);
  for (std::size_t q = 0; q < study.questions.size(); ++q) {
    json["questions"].push_back(summary.question(q));
  }
  return json;
}

}  // namespace stroma::study
