// SPDX-License-Identifier: Apache-2.0
#include "core/number_list.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/diagnostics.h"

namespace stroma {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view token(std::string_view text, std::size_t begin) {
  return text.substr(begin, tokenEnd(text, begin) - begin);
}

// std::from_chars has no "+5".
std::size_t skipPlus(std::string_view text, std::size_t at) {
  const bool plus =
      at + 1 < text.size() && text[at] == '+' && (isDigit(text[at + 1]) || text[at + 1] == '.');
  return plus ? at + 1 : at;
}

// "nan", "inf" and "infinity", which are neither numbers nor units to us.
bool isNotFinite(std::string_view word) {
  std::string lower;
  for (const char c : word.substr(0, 10)) {
    if (lower.empty() && (c == '+' || c == '-')) continue;
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return lower == "nan" || lower == "inf" || lower == "infinity" || lower.starts_with("nan(");
}

ParseError tooMany(std::string_view text, std::size_t at, std::size_t most, std::string_view noun) {
  return tokenError(text, at, "value-count",
                    "expected " + std::to_string(most) + " " + std::string(noun) +
                        (most == 1 ? "" : "s") + ", got more");
}

// What to say of a token that is not, or not only, a number.
ParseError badNumber(std::string_view text, std::size_t begin) {
  const std::string_view word = token(text, begin);
  if (isNotFinite(word)) {
    return tokenError(text, begin, "value-not-finite", quoted(word) + " is not a finite number");
  }
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) {
    return tokenError(text, begin, "value-number", quoted(word) + " is not a number");
  }
  std::string hint;
  const bool decimal = comma > 0 && comma + 1 < word.size() && isDigit(word[comma - 1]) &&
                       isDigit(word[comma + 1]) && word.find(',', comma + 1) == word.npos;
  if (decimal && word.size() < 30) {
    std::string corrected(word);
    corrected[comma] = '.';
    hint = "write " + quoted(corrected);
  }
  return tokenError(text, begin, "value-comma",
                    quoted(word) + " has a comma: numbers have a decimal point and blanks between",
                    std::move(hint));
}

// Reads one list; knows the attribute's unit and what the suffixes met so far mean.
class NumberReader {
 public:
  NumberReader(std::string_view text, const ValueContext& context, std::vector<double>& out)
      : text_(text), context_(context), out_(out), first_(out.size()) {}

  std::optional<ParseError> read(std::size_t most) {
    if (!context_.unit.empty()) {
      own_ = parseUnit(context_.unit);
      if (!own_) {
        return tokenError(
            text_, 0, "unit-declared",
            "the attribute is declared with the unknown unit " + quoted(context_.unit));
      }
    }
    for (at_ = skipBlanks(text_, 0); at_ < text_.size(); at_ = skipBlanks(text_, at_)) {
      if (out_.size() - first_ == most) return tooMany(text_, at_, most, "number");
      if (auto error = readNumber()) return error;
    }
    return applyUnits();
  }

 private:
  // Position of a number in the list, and what its own suffix multiplies it by.
  struct Suffixed {
    std::size_t index;
    double factor;
  };

  std::optional<ParseError> readNumber() {
    const std::size_t begin = at_;
    double number = 0;
    const char* const end = text_.data() + text_.size();
    const auto [stop, status] = std::from_chars(text_.data() + skipPlus(text_, begin), end, number);
    if (status == std::errc::result_out_of_range) {
      return tokenError(text_, begin, "value-overflow",
                        quoted(token(text_, begin)) + " is too large or too small for a number");
    }
    if (status != std::errc() || !std::isfinite(number)) return badNumber(text_, begin);
    at_ = static_cast<std::size_t>(stop - text_.data());
    out_.push_back(number);
    const std::size_t unitBegin = skipBlanks(text_, at_);
    if (unitBegin == text_.size() || (unitBegin > at_ && !startsUnit(unitBegin))) {
      if (number != 0 && !bare_) bare_ = {begin, at_ - begin};
      return std::nullopt;
    }
    if (!startsUnit(unitBegin) && text_[unitBegin] != '/') return badNumber(text_, begin);
    return readSuffix(begin, unitBegin);
  }

  // A letter, '%', a non-ASCII character such as "µ" or "°", or the "1/" of "1/s".
  [[nodiscard]] bool startsUnit(std::size_t at) const {
    const char c = text_[at];
    if (isLetter(c)) return !isNotFinite(token(text_, at));
    return c == '%' || (static_cast<unsigned char>(c) & 0x80u) != 0 ||
           (c == '1' && at + 1 < text_.size() && text_[at + 1] == '/');
  }

  // Units may have blanks in them: up to the next number, or the length that no unit has.
  [[nodiscard]] std::size_t unitEnd(std::size_t begin) const {
    std::size_t end = tokenEnd(text_, begin);
    while (end - begin <= mostUnitText) {
      const std::size_t next = skipBlanks(text_, end);
      if (next == text_.size()) break;
      if (!startsUnit(next) && text_[next] != '/' && text_[next] != '*') break;
      end = tokenEnd(text_, next);
    }
    return end;
  }

  std::optional<ParseError> readSuffix(std::size_t numberBegin, std::size_t begin) {
    const bool attached = begin == at_;
    at_ = unitEnd(begin);
    const std::string_view written = text_.substr(begin, at_ - begin);
    if (written != suffix_) {
      std::string unitText(written.substr(0, mostUnitText + 1));
      if (unitText.front() == '/') unitText.insert(0, "1");
      const auto unit = parseUnit(unitText);
      // "1.5.2" and "2e" are numbers gone wrong rather than numbers with a unit
      const bool mangled = std::ranges::any_of(token(text_, begin), isDigit) ||
                           written.front() == 'e' || written.front() == 'E';
      if (!unit && attached && mangled) return badNumber(text_, numberBegin);
      if (auto error = check(unit, written, begin)) return error;
      suffix_ = written;
      factor_ = unit->factor / own_->factor;
    }
    suffixed_.push_back({out_.size() - 1 - first_, factor_});
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ParseError> check(const std::optional<Unit>& unit,
                                                std::string_view written, std::size_t begin) const {
    ParseError error{begin, written.size(), {}, {}, {}};
    if (!unit && !own_) {
      error.id = "value-number";
      error.message = quoted(written) + " is not a number";
    } else if (!unit) {
      error.id = "unit-unknown";
      error.message =
          "unknown unit " + quoted(written) + ": expected " + dimensionName(own_->dimension);
      error.hint = unitHint(written, own_->dimension);
    } else if (!own_) {
      error.id = "unit-unexpected";
      error.message = "the value has no unit, got " + quoted(written);
    } else if (unit->dimension != own_->dimension) {
      error.id = "unit-dimension";
      error.message =
          "expected " + dimensionName(own_->dimension) + ", got " + dimensionName(unit->dimension);
    } else {
      return std::nullopt;
    }
    return error;
  }

  std::optional<ParseError> applyUnits() {
    const std::size_t count = out_.size() - first_;
    double common = own_ ? context_.units.toSi(own_->dimension) : 1.0;
    if (!suffixed_.empty() && suffixed_.back().index + 1 == count) {
      common = suffixed_.back().factor;
    } else if (!suffixed_.empty() && bare_) {
      return ParseError{
          bare_->first, bare_->second, "unit-mixed",
          "some numbers have a unit and this one has none",
          "give each number its unit, or only the last one, which then holds for all"};
    }
    if (common == 1 && suffixed_.empty()) return std::nullopt;
    auto suffixed = suffixed_.begin();
    for (std::size_t i = 0; i < count; ++i) {
      const bool ownFactor = suffixed != suffixed_.end() && suffixed->index == i;
      double& number = out_[first_ + i];
      number = scaled(number, ownFactor ? (suffixed++)->factor : common);
      if (!std::isfinite(number)) {
        return ParseError{
            0, text_.size(), "value-overflow", "a number is too large in SI units", {}};
      }
    }
    return std::nullopt;
  }

  std::string_view text_;
  const ValueContext& context_;
  std::vector<double>& out_;
  std::size_t first_;
  std::size_t at_ = 0;
  std::optional<Unit> own_;
  std::string_view suffix_;
  double factor_ = 1;
  std::vector<Suffixed> suffixed_;
  std::optional<std::pair<std::size_t, std::size_t>> bare_;  // first number, not 0, without suffix
};

// One whole number from `at` on; `at` moves behind it.
enum class WholeNumber { good, bad, tooLarge };
WholeNumber takeWholeNumber(std::string_view text, std::size_t& at, int& number) {
  const auto [stop, status] =
      std::from_chars(text.data() + skipPlus(text, at), text.data() + text.size(), number);
  if (status == std::errc::result_out_of_range) return WholeNumber::tooLarge;
  if (status != std::errc()) return WholeNumber::bad;
  at = static_cast<std::size_t>(stop - text.data());
  return WholeNumber::good;
}

ParseError badWholeNumber(std::string_view text, std::size_t begin, WholeNumber why) {
  const std::string_view word = token(text, begin);
  if (why == WholeNumber::tooLarge) {
    return tokenError(text, begin, "value-overflow",
                      quoted(word) + " is too large for a whole number");
  }
  if (word.find(',') != word.npos || isNotFinite(word)) return badNumber(text, begin);
  return tokenError(text, begin, "value-number", quoted(word) + " is not a whole number");
}

ParseError negativeIndex(std::string_view text, std::size_t begin) {
  return tokenError(text, begin, "index-negative",
                    quoted(token(text, begin)) + " is negative: indices count from 0");
}

// "A", "A-B" or "A-B-step"; whatever else the token may be is an error.
struct IndexRange {
  int first = 0;
  int last = 0;
  int step = 1;
};

std::optional<ParseError> takeRange(std::string_view text, std::size_t& at, IndexRange& range) {
  const std::size_t begin = at;
  const auto ended = [&] { return at == text.size() || isBlank(text[at]); };
  const auto next = [&](int& number) {
    if (at >= text.size() || text[at] != '-') return WholeNumber::bad;
    return takeWholeNumber(text, ++at, number);
  };
  if (auto status = takeWholeNumber(text, at, range.first); status != WholeNumber::good) {
    return badWholeNumber(text, begin, status);
  }
  range.last = range.first;
  if (range.first < 0) return negativeIndex(text, begin);
  if (ended()) return std::nullopt;
  if (auto status = next(range.last); status != WholeNumber::good) {
    return badWholeNumber(text, begin, status);
  }
  if (range.last < 0) return negativeIndex(text, begin);
  range.step = range.first <= range.last ? 1 : -1;
  if (ended()) return std::nullopt;
  if (auto status = next(range.step); status != WholeNumber::good || !ended()) {
    return badWholeNumber(text, begin, status);
  }
  if (range.step == 0) {
    return tokenError(text, begin, "index-step", quoted(token(text, begin)) + " has the step 0");
  }
  if ((range.step > 0) != (range.first <= range.last)) std::swap(range.first, range.last);
  return std::nullopt;
}

}  // namespace

std::size_t skipBlanks(std::string_view text, std::size_t begin) {
  while (begin < text.size() && isBlank(text[begin])) ++begin;
  return begin;
}

std::size_t tokenEnd(std::string_view text, std::size_t begin) {
  while (begin < text.size() && !isBlank(text[begin])) ++begin;
  return begin;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(skipBlanks(text, 0));
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

ParseError tokenError(std::string_view text, std::size_t begin, std::string id, std::string message,
                      std::string hint) {
  return {begin, tokenEnd(text, begin) - begin, std::move(id), std::move(message), std::move(hint)};
}

std::optional<ParseError> parseNumbers(std::string_view text, const ValueContext& context,
                                       std::size_t most, std::vector<double>& out) {
  return NumberReader(text, context, out).read(most);
}

std::optional<ParseError> parseWholeNumbers(std::string_view text, std::size_t most,
                                            std::vector<int>& out) {
  const std::size_t first = out.size();
  for (std::size_t at = skipBlanks(text, 0); at < text.size(); at = skipBlanks(text, at)) {
    const std::size_t begin = at;
    int number = 0;
    const WholeNumber status = takeWholeNumber(text, at, number);
    const bool ended = at == text.size() || isBlank(text[at]);
    if (status != WholeNumber::good || !ended) return badWholeNumber(text, begin, status);
    if (out.size() - first == most) return tooMany(text, begin, most, "whole number");
    out.push_back(number);
  }
  return std::nullopt;
}

std::optional<ParseError> parseIndices(std::string_view text, std::size_t most,
                                       std::vector<Index>& out) {
  const std::size_t first = out.size();
  if (auto error = parseWholeNumbers(text, most, out)) return error;
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  const auto negative = std::find_if(begin, out.end(), [](Index i) { return i < 0; });
  if (negative == out.end()) return std::nullopt;
  std::size_t at = skipBlanks(text, 0);
  for (auto i = begin; i != negative; ++i) at = skipBlanks(text, tokenEnd(text, at));
  return negativeIndex(text, at);
}

std::optional<ParseError> parseIndexRanges(std::string_view text, std::vector<Index>& out) {
  for (std::size_t at = skipBlanks(text, 0); at < text.size(); at = skipBlanks(text, at)) {
    const std::size_t begin = at;
    IndexRange range;
    if (auto error = takeRange(text, at, range)) return error;
    const std::int64_t span = std::int64_t{range.last} - range.first;
    const auto count = static_cast<std::size_t>(span / range.step + 1);
    if (count > IndexList::maxCount - std::min(out.size(), IndexList::maxCount)) {
      return tokenError(text, begin, "index-too-many",
                        "more than " + std::to_string(IndexList::maxCount) + " indices");
    }
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(static_cast<Index>(range.first + static_cast<std::int64_t>(i) * range.step));
    }
  }
  return std::nullopt;
}

}  // namespace stroma
