// SPDX-License-Identifier: Apache-2.0
#include "core/xml_problem.h"

#include <algorithm>
#include <vector>

#include "core/diagnostics.h"

namespace stroma {
namespace {

constexpr std::string_view blanks = " \t\r\n";

class Scanner {
 public:
  explicit Scanner(const SourceText& source) : source_(source), text_(source.text()) {}

  std::optional<XmlProblem> run() {
    while (!problem_ && (at_ = text_.find('<', at_)) != std::string_view::npos) {
      if (startsWith("<!--")) {
        skipTo("-->", 4, "this comment is not closed by -->");
      } else if (startsWith("<![CDATA[")) {
        skipTo("]]>", 9, "this CDATA section is not closed by ]]>");
      } else if (startsWith("<?")) {
        skipTo("?>", 2, "this declaration is not closed by ?>");
      } else if (startsWith("<!")) {
        skipTo(">", 2, "this <! section is not closed by >");
      } else if (startsWith("</")) {
        closeElement();
      } else {
        openElement();
      }
    }
    if (!problem_ && !open_.empty()) {
      const std::string name(open_.back());
      report(
          quoted(open_.back()) + " is not closed: the file ends without </" + shortened(name) + ">",
          offsetOf(open_.back()), name.size());
    }
    return problem_;
  }

 private:
  static std::string shortened(std::string_view name) {
    const std::string text = quoted(name);
    return text.substr(1, text.size() - 2);
  }

  [[nodiscard]] bool startsWith(std::string_view what) const {
    return text_.substr(at_, what.size()) == what;
  }
  [[nodiscard]] std::size_t offsetOf(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - text_.data());
  }
  [[nodiscard]] bool atEnd() const { return at_ >= text_.size(); }
  void skipBlanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

  std::string_view takeName() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n=/<>\"'", at_), text_.size());
    const std::string_view name = text_.substr(at_, end - at_);
    at_ = end;
    return name;
  }

  void report(std::string message, std::size_t offset, std::size_t length, std::string hint = "") {
    problem_ = {std::move(message), offset, std::max<std::size_t>(length, 1), std::move(hint)};
  }

  void skipTo(std::string_view end, std::size_t opening, const char* message) {
    const std::size_t found = text_.find(end, at_ + opening);
    if (found == std::string_view::npos) return report(message, at_, opening);
    at_ = found + end.size();
  }

  void closeElement() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string_view name = takeName();
    skipBlanks();
    if (atEnd() || text_[at_] != '>') {
      return report("</" + shortened(name) + " is not closed by >", begin, 2 + name.size());
    }
    ++at_;
    if (open_.empty()) {
      report("</" + shortened(name) + "> closes nothing: no element is open here", begin,
             at_ - begin);
    } else if (open_.back() != name) {
      const auto opened = source_.position(offsetOf(open_.back()));
      report("</" + shortened(name) + "> stands where " + quoted(open_.back()) + " is to be closed",
             begin, at_ - begin,
             quoted(open_.back()) + " was opened in line " + std::to_string(opened.line) +
                 "; close it by </" + shortened(open_.back()) + "> or end its tag with />");
    } else {
      open_.pop_back();
    }
  }

  void openElement() {
    const std::size_t begin = at_++;
    const std::string_view element = takeName();
    if (element.empty()) {
      return report("'<' begins no element here", begin, 1, "write &lt; for the character itself");
    }
    std::vector<std::string_view> seen;
    std::string_view lastName, lastValue;
    while (!problem_) {
      skipBlanks();
      if (atEnd() || text_[at_] == '<') {
        return report("the tag of " + quoted(element) + " is not closed by > or />", begin + 1,
                      element.size());
      }
      if (text_[at_] == '>') {
        ++at_;
        open_.push_back(element);
        return;
      }
      if (startsWith("/>")) {
        at_ += 2;
        return;
      }
      const std::string_view name = takeName();
      const bool isAttribute = !name.empty() && takeValue(name, lastValue);
      if (problem_) return;
      if (!isAttribute) return malformed(element, name, lastName, lastValue);
      if (std::ranges::find(seen, name) != seen.end()) {
        return report("attribute " + quoted(name) + " is given twice", offsetOf(name), name.size());
      }
      seen.push_back(name);
      lastName = name;
    }
  }

  // Reads ="value". False, and `value` unchanged, where there is none.
  bool takeValue(std::string_view name, std::string_view& value) {
    skipBlanks();
    if (atEnd() || text_[at_] != '=') return false;
    ++at_;
    skipBlanks();
    if (atEnd() || (text_[at_] != '"' && text_[at_] != '\'')) {
      report("the value of " + quoted(name) + " is not in quotes", offsetOf(name), name.size(),
             "write " + shortened(name) + "=\"...\"");
      return false;
    }
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) {
      notClosed(name);
      return false;
    }
    value = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return true;
  }

  void notClosed(std::string_view name) {
    report("the value of " + quoted(name) + " is not closed by a quote", offsetOf(name),
           name.size());
  }

  void malformed(std::string_view element, std::string_view name, std::string_view lastName,
                 std::string_view lastValue) {
    // a forgotten quote shows only at the next one, elements later
    if (lastValue.find_first_of("<>") != std::string_view::npos) return notClosed(lastName);
    if (!name.empty()) {
      return report("attribute " + quoted(name) + " has no value", offsetOf(name), name.size(),
                    "write " + shortened(name) + "=\"...\"");
    }
    report("this has no place in the tag of " + quoted(element), at_, 1);
  }

  const SourceText& source_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string_view> open_;  // names of the elements that are open, outermost first
  std::optional<XmlProblem> problem_;
};

}  // namespace

std::optional<XmlProblem> findXmlProblem(const SourceText& source) { return Scanner(source).run(); }

}  // namespace stroma
