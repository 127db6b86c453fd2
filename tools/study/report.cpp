// SPDX-License-Identifier: Apache-2.0
#include "tools/study/report.h"

#include "core/xml_text.h"

namespace stroma::study {
namespace fs = std::filesystem;
namespace {

std::string wordsOf(const Json& summary) {
  std::string html = "<ul>";
  for (const Json& question : summary["questions"]) {
    for (const Json& sentence : question["sentences"]) {
      html += "<li>" + xmlText(sentence.get<std::string>()) + "</li>";
    }
  }
  return html + "</ul>";
}

// Puts the texts in place of @NAME@; what they hold is not looked at again.
std::string fill(const std::string& page, const std::map<std::string, std::string>& texts) {
  std::string out;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t open = std::min(page.find('@', at), page.size());
    out += page.substr(at, open - at);
    if (open == page.size()) break;
    const std::size_t close = std::min(page.find('@', open + 1), page.size());
    const auto text = texts.find(page.substr(open + 1, close - open - 1));
    if (text != texts.end()) out += text->second;
    at = close + 1;
  }
  return out;
}

}  // namespace

std::string inScript(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    c == '<' ? text += "\\u003c" : text += c;
  }
  return text;
}

fs::path reportFolder() {
  std::error_code failure;
  return fs::read_symlink("/proc/self/exe", failure).parent_path().parent_path() / "share" /
         "stroma" / "report";
}

std::optional<std::string> reportPage(const Json& summary, const Results& results,
                                      const fs::path& folder, std::string& problem) {
  std::map<std::string, std::string> texts{{"TITLE", xmlText(summary["title"].get<std::string>())},
                                           {"CITE", xmlText(summary["cite"].get<std::string>())},
                                           {"TEXT", xmlText(summary["text"].get<std::string>())},
                                           {"WORDS", wordsOf(summary)},
                                           {"DATA", inScript(summary)}};
  Json pictures = Json::object();
  for (const auto& [id, result] : results) {
    const bool has = result.contains("picture") && !result["picture"].is_null();
    if (has) pictures[id] = result["picture"];
  }
  texts["PICTURES"] = inScript(pictures);
  std::string page;
  for (const auto& [name, file] : {std::pair{"PAGE", "page.html"},
                                   {"STYLE", "report.css"},
                                   {"CHART", "chart.min.js"},
                                   {"PICTURE", "picture.js"},
                                   {"SCRIPT", "report.js"}}) {
    auto text = readFile(folder / file);
    if (!text) {
      problem = "cannot read '" + (folder / file).string() + "', a part of the report";
      return std::nullopt;
    }
    texts[name] = std::move(*text);
  }
  return fill(texts["PAGE"], texts);
}

}  // namespace stroma::study
