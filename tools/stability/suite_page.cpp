// SPDX-License-Identifier: Apache-2.0
#include "core/xml_text.h"
#include "tools/stability/suite_results.h"
#include "tools/study/report.h"

namespace stroma::stability {
namespace {

using study::Json;

constexpr const char* style = R"css(
table.suite { white-space: normal; }
table.suite th { writing-mode: vertical-rl; text-align: left; max-height: 14rem; padding: .4rem .2rem; }
table.suite th:first-child { writing-mode: horizontal-tb; }
table.suite td { text-align: center; padding: .2rem .3rem; }
table.suite td:first-child { text-align: left; white-space: nowrap; }
td.passed { color: var(--good); }
td.failed { color: var(--bad); font-weight: 700; }
td.other { color: var(--quiet); }
.pictures figcaption.failed { color: var(--bad); }
)css";

// Pictures are drawn when they come into sight.
constexpr const char* script = R"js(
const pictures = JSON.parse(document.getElementById('pictures').textContent);
const seen = new IntersectionObserver(entries => entries.forEach(entry => {
  if (!entry.isIntersecting) return;
  seen.unobserve(entry.target);
  drawPicture(entry.target, pictures[entry.target.dataset.id]);
}));
document.querySelectorAll('canvas').forEach(canvas => seen.observe(canvas));
)js";

std::string text(const Json& json, const char* key) { return xmlText(json.value(key, "")); }

std::string limitersOf(const Json& cell) {
  std::string list;
  if (!cell.contains("limiters")) return list;
  for (const auto& [name, count] : cell["limiters"].items()) {
    list += (list.empty() ? "" : ", ") + name + " " + std::to_string(count.get<long>());
  }
  return xmlText(list);
}

std::string tableOf(const Json& summary) {
  std::string html = "<div class=\"scroll\"><table class=\"suite\"><tr><th>case</th>";
  for (const Json& method : summary["methods"]) {
    html += "<th title=\"" + text(method, "text") + "\">" + text(method, "name") +
            (method["default"].get<bool>() ? " (default)" : "") + "</th>";
  }
  html += "</tr>\n";
  int number = 0;
  for (const Json& one : summary["cases"]) {
    html += "<tr><td><a href=\"#case" + std::to_string(number++) + "\">" + text(one, "name") +
            "</a></td>";
    for (const Json& cell : one["cells"]) {
      const auto state = cell["state"].get<std::string>();
      const bool ran = state == "passed" || state == "failed";
      const std::string limiters = limitersOf(cell);
      html += "<td class=\"" + (ran ? state : "other") + "\" title=\"" + text(cell, "method") +
              ": " + state + ". " + text(cell, "why") + " " + limiters + "\">" +
              (state == "passed"           ? "passed"
               : state == "failed"         ? "failed"
               : state == "not applicable" ? "n/a"
                                           : "&ndash;") +
              (limiters.empty() ? "" : "*") + "</td>";
    }
    html += "</tr>\n";
  }
  return html +
         "</table></div>\n<p class=\"note\">* a limiter acted: see below. n/a: does not apply, "
         "the reason shows when the pointer rests on it and below. &ndash;: not run.</p>\n";
}

std::string caseOf(const Json& one, int number, const Results& results) {
  std::string html = "<h2 id=\"case" + std::to_string(number) + "\">" + text(one, "name") +
                     "</h2>\n<p class=\"lead\">" + text(one, "text") + " (" + text(one, "scene") +
                     ")</p>\n";
  std::string pictures;
  for (const Json& cell : one["cells"]) {
    const auto state = cell["state"].get<std::string>();
    if (state == "not applicable") {
      html += "<p class=\"note\">" + text(cell, "method") +
              " does not apply: " + text(cell, "why") + "</p>\n";
    }
    if (state != "passed" && state != "failed") continue;
    std::string caption = text(cell, "method") + ": " + state;
    if (state == "failed") caption += ". " + text(cell, "why");
    const std::string limiters = limitersOf(cell);
    if (!limiters.empty()) caption += ". Limiters: " + limiters;
    const auto id = cell.value("id", "");
    const auto found = results.find(id);
    const bool drawn = found != results.end() && found->second.contains("picture") &&
                       !found->second["picture"].is_null();
    pictures += "<figure>" +
                (drawn ? "<canvas data-id=\"" + xmlText(id) + "\"></canvas>" : std::string()) +
                "<figcaption class=\"" + state + "\">" + caption + "</figcaption></figure>\n";
  }
  return html + "<div class=\"pictures\">" + pictures + "</div>\n";
}

}  // namespace

std::optional<std::string> pageOf(const Json& summary, const Results& results,
                                  const std::filesystem::path& parts, std::string& problem) {
  const auto css = study::readFile(parts / "report.css");
  const auto picture = study::readFile(parts / "picture.js");
  if (!css || !picture) {
    problem = "cannot read '" + (parts / (css ? "picture.js" : "report.css")).string() +
              "', a part of the page";
    return std::nullopt;
  }
  const Json& totals = summary["totals"];
  const auto count = [&](const char* key) { return std::to_string(totals[key].get<int>()); };
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      text(summary, "title") + "</title>\n<style>\n" + *css + style +
      "</style>\n</head>\n<body>\n<h1>" + text(summary, "title") + "</h1>\n<p class=\"lead\">" +
      text(summary, "text") + "</p>\n<p>" + count("cases") + " cases: " + count("passed") +
      " passed, " + count("failed") + " failed with the default methods; " +
      count("compared_passed") + " of " + count("compared") +
      " runs with methods compared passed.</p>\n" + tableOf(summary);
  if (!summary["elsewhere"].empty()) html += "<h2>Held by other tests</h2>\n<ul>";
  for (const Json& e : summary["elsewhere"]) {
    html += "<li>" + text(e, "name") + ": <code>" + text(e, "test") + "</code>. " +
            text(e, "text") + "</li>\n";
  }
  if (!summary["elsewhere"].empty()) html += "</ul>\n";
  int number = 0;
  for (const Json& one : summary["cases"]) html += caseOf(one, number++, results);
  Json pictures = Json::object();
  for (const auto& [id, result] : results) {
    if (result.contains("picture") && !result["picture"].is_null()) {
      pictures[id] = result["picture"];
    }
  }
  html += "<footer>" + text(summary["machine"], "processor") + ", " +
          text(summary["machine"], "build") + "</footer>\n";
  html += "<script type=\"application/json\" id=\"pictures\">" + study::inScript(pictures) +
          "</script>\n<script>\n" + *picture + "</script>\n<script>" + script +
          "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace stroma::stability
