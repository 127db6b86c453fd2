// SPDX-License-Identifier: Apache-2.0
#include "core/diagnostics.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>
#include <utility>

#include "core/json.h"
#include "core/utf8.h"

namespace stroma {
namespace {

constexpr std::size_t mostMessage = 1000;  // characters of a message or hint that are shown
constexpr std::size_t mostExcerpt = 160;   // bytes of a source line that are shown
constexpr std::size_t mostWord = 64;       // bytes of a word that is compared with names
constexpr std::string_view ellipsis = "...";

std::string_view name(Severity severity) {
  constexpr std::array<std::string_view, 3> names{"error", "warning", "note"};
  return names[static_cast<std::size_t>(severity)];
}

std::string counted(int count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

// Moves the first character of `rest` to `out`, escaped if it is a control character or not UTF-8;
// a tab becomes a blank. Returns the number of characters written.
std::size_t movePrintable(std::string_view& rest, std::string& out) {
  constexpr std::string_view hex = "0123456789abcdef";
  const std::size_t size = characterSize(rest);
  const std::string_view character = rest.substr(0, size == 0 ? 1 : size);
  rest.remove_prefix(character.size());
  const auto code = static_cast<unsigned char>(character.front());
  const bool secondControlSet =
      size == 2 && code == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  if (code == '\t') {
    out += ' ';
    return 1;
  }
  if (size > 0 && code >= 0x20 && code != 0x7F && !secondControlSet) {
    out += character;
    return 1;
  }
  for (const char c : character) {
    const auto byte = static_cast<unsigned char>(c);
    out += "\\x";
    out += hex[byte >> 4];
    out += hex[byte & 0xF];
  }
  return 4 * character.size();
}

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  for (std::size_t characters = 0; !text.empty(); ++characters) {
    if (characters == most) return out += ellipsis;
    movePrintable(text, out);
  }
  return out;
}

// Room for the characters that are shown, whatever their size; the rest need not be kept.
void shorten(std::string& text) { text.resize(std::min(text.size(), 4 * mostMessage + 4)); }

// The part of a line round the byte `caret`, cut between characters.
std::pair<std::size_t, std::size_t> window(std::string_view line, std::size_t caret) {
  if (line.size() <= mostExcerpt) return {0, line.size()};
  const auto inside = [&](std::size_t i) {
    return i < line.size() && (static_cast<unsigned char>(line[i]) & 0xC0u) == 0x80u;
  };
  std::size_t begin = caret > mostExcerpt / 2 ? caret - mostExcerpt / 2 : 0;
  begin = std::min(begin, line.size() - mostExcerpt);
  std::size_t end = begin + mostExcerpt;
  while (begin < caret && inside(begin)) ++begin;
  while (end > caret + 1 && inside(end)) --end;
  return {begin, end};
}

// The source line and the carets under it.
std::string excerpt(const SourceRange& where) {
  const SourceText& source = *where.source;
  if (source.text().empty()) return {};
  const int number = source.position(where.offset).line;
  const std::string_view line = source.line(number);
  const auto lineOffset = static_cast<std::size_t>(line.data() - source.text().data());
  const std::size_t wanted = where.offset > lineOffset ? where.offset - lineOffset : 0;
  const std::size_t caret = std::min(wanted, line.size());
  const std::size_t caretEnd = caret + std::min(where.length, line.size() - caret);
  const auto [begin, end] = window(line, caret);

  std::string shown(begin > 0 ? ellipsis : "");
  std::size_t indent = shown.size();
  std::size_t underlined = 0;
  for (std::string_view rest = line.substr(begin, end - begin); !rest.empty();) {
    const std::size_t at = end - rest.size();
    const std::size_t width = movePrintable(rest, shown);
    if (at < caret) indent += width;
    if (at >= caret && at < caretEnd) underlined += width;
  }
  if (end < line.size()) shown += ellipsis;

  std::string label = std::to_string(number);
  label.insert(0, label.size() < 5 ? 5 - label.size() : 0, ' ');
  return label + " | " + shown + "\n" + std::string(label.size(), ' ') + " | " +
         std::string(indent, ' ') + "^" +
         std::string(std::max<std::size_t>(underlined, 1) - 1, '~') + "\n";
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Optimal string alignment distance: three rows of the table are enough for swaps of neighbours.
std::size_t editDistance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, mostWord + 1>;
  Row beforeLast{}, last{}, row{};
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    beforeLast = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row[b.size()];
}

void writeJson(const Diagnostic& diagnostic, JsonWriter& json) {
  json.beginObject().member("severity", name(diagnostic.severity)).member("id", diagnostic.id);
  json.member("message", diagnostic.message);
  if (diagnostic.where) {
    const SourceText& source = *diagnostic.where.source;
    json.member("file", source.name());
    if (!source.text().empty()) {
      const auto begin = source.position(diagnostic.where.offset);
      const auto end = source.position(diagnostic.where.offset + diagnostic.where.length);
      json.member("line", begin.line).member("column", begin.column);
      json.member("endLine", end.line).member("endColumn", end.column);
    }
  }
  if (!diagnostic.hint.empty()) json.member("hint", diagnostic.hint);
  const std::string lines = diagnostic.where ? excerpt(diagnostic.where) : "";
  if (!lines.empty()) json.member("excerpt", lines);
  json.endObject();
}

}  // namespace

void Diagnostics::report(Diagnostic diagnostic) {
  if (++counts_[static_cast<std::size_t>(diagnostic.severity)] > mostKept) return;
  shorten(diagnostic.message);
  shorten(diagnostic.hint);
  kept_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string id, std::string message, SourceRange where, std::string hint) {
  report({Severity::error, std::move(id), std::move(message), std::move(where), std::move(hint)});
}

void Diagnostics::warning(std::string id, std::string message, SourceRange where,
                          std::string hint) {
  report({Severity::warning, std::move(id), std::move(message), std::move(where), std::move(hint)});
}

void Diagnostics::note(std::string id, std::string message, SourceRange where, std::string hint) {
  report({Severity::note, std::move(id), std::move(message), std::move(where), std::move(hint)});
}

int Diagnostics::omitted() const {
  int sum = 0;
  for (const int count : counts_) sum += std::max(0, count - mostKept);
  return sum;
}

std::vector<const Diagnostic*> Diagnostics::inOrder() const {
  using Key = std::tuple<std::size_t, int, int>;
  std::map<std::string_view, std::size_t> files;
  std::vector<std::pair<Key, const Diagnostic*>> keyed;
  for (const Diagnostic& diagnostic : kept_) {
    const SourceText* source = diagnostic.where.source.get();
    const auto file = files.try_emplace(source ? source->name() : std::string_view(), files.size());
    const auto at = source ? source->position(diagnostic.where.offset) : SourceText::Position{};
    keyed.push_back({{file.first->second, at.line, at.column}, &diagnostic});
  }
  std::ranges::stable_sort(keyed, {}, [](const auto& item) { return item.first; });
  std::vector<const Diagnostic*> order;
  for (const auto& item : keyed) order.push_back(item.second);
  return order;
}

std::string Diagnostics::text() const {
  std::string out;
  for (const Diagnostic* diagnostic : inOrder()) out += format(*diagnostic);
  if (omitted() > 0) out += "... and " + counted(omitted(), "more problem") + ".\n";
  if (errorCount() > 0) {
    out += counted(errorCount(), "error") + ", " + counted(warningCount(), "warning") +
           "; nothing was started.\n";
  }
  return out;
}

std::string Diagnostics::json() const {
  JsonWriter json;
  json.beginObject().member("errors", errorCount()).member("warnings", warningCount());
  json.member("omitted", omitted()).key("diagnostics").beginArray();
  for (const Diagnostic* diagnostic : inOrder()) writeJson(*diagnostic, json);
  json.endArray().endObject();
  return json.text();
}

std::string format(const Diagnostic& diagnostic) {
  std::string out;
  if (diagnostic.where) out += printable(diagnostic.where.text(), mostMessage) + ": ";
  out += std::string(name(diagnostic.severity)) + ": " + printable(diagnostic.message, mostMessage);
  if (!diagnostic.id.empty()) out += "  [" + diagnostic.id + "]";
  out += "\n";
  if (diagnostic.where) out += excerpt(diagnostic.where);
  for (std::string_view rest = diagnostic.hint; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    out += "      = " + printable(rest.substr(0, end), mostMessage) + "\n";
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out;
}

std::string quoted(std::string_view text, std::size_t most) {
  return "'" + printable(text, most) + "'";
}

std::vector<std::string> nearestNames(std::string_view wrong,
                                      std::span<const std::string> candidates, std::size_t most) {
  if (wrong.empty() || wrong.size() > mostWord) return {};
  std::vector<std::pair<std::size_t, const std::string*>> near;
  for (const std::string& candidate : candidates) {
    const std::size_t shorter = std::min(wrong.size(), candidate.size());
    const std::size_t longer = std::max(wrong.size(), candidate.size());
    // a third of the letters may be wrong, but not all
    const std::size_t allowed = std::min(std::max<std::size_t>(1, longer / 3), shorter - 1);
    if (shorter == 0 || longer > mostWord || longer - shorter > allowed) continue;
    const std::size_t distance = editDistance(wrong, candidate);
    if (distance <= allowed) near.push_back({distance, &candidate});
  }
  std::ranges::stable_sort(near, {}, [](const auto& item) { return item.first; });
  std::vector<std::string> names;
  for (const auto& item : near) {
    if (names.size() == most) break;
    if (std::ranges::find(names, *item.second) == names.end()) names.push_back(*item.second);
  }
  return names;
}

std::string didYouMean(std::string_view wrong, std::span<const std::string> candidates) {
  const auto nearest = nearestNames(wrong, candidates, 1);
  return nearest.empty() ? "" : "did you mean " + quoted(nearest.front()) + "?";
}

}  // namespace stroma
