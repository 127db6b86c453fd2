// SPDX-License-Identifier: Apache-2.0
// Attributes: the typed, documented parameters of nodes and components. One declaration gives the
// name, the help, the unit, the range and the default; XML parsing, checks, reference pages, the
// XSD and run-time changes all read it.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>

#include "core/source.h"
#include "core/value.h"

namespace stroma {

class AttributeBase;
class AttributeOwner;

// What is known of an attribute besides its name, type, default and help.
struct AttributeInfo {
  std::string_view unit = "";  // SI unit of the stored value, "" = text or a count
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool exclusiveMin = false;  // min itself is not allowed
  bool exclusiveMax = false;
  bool required = false;          // the scene must give it
  bool runtime = false;           // may be changed while the simulation runs
  bool output = false;            // computed by the component; a scene can link to it, not set it
  bool autolink = false;          // taken over by src="@component"
  std::string_view aliases = "";  // other accepted names, separated by blanks
};

class AttributeBase {
 public:
  AttributeBase(AttributeOwner* owner, std::string_view name, std::string_view doc,
                const AttributeInfo& info);
  virtual ~AttributeBase() = default;
  AttributeBase(const AttributeBase&) = delete;
  AttributeBase& operator=(const AttributeBase&) = delete;

  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] std::string_view doc() const { return doc_; }
  [[nodiscard]] const AttributeInfo& info() const { return info_; }
  [[nodiscard]] AttributeOwner& owner() const { return *owner_; }
  [[nodiscard]] bool answersTo(std::string_view name) const;  // the name or one of the aliases

  // Whether the scene gave a value or a data link.
  [[nodiscard]] bool isSet() const { return isSet_; }
  // Where the value was written; empty for defaults.
  [[nodiscard]] const SourceRange& where() const { return where_; }
  // Source of a data link ("@component.attribute"), null without one.
  [[nodiscard]] const AttributeBase* source() const { return source_; }

  // Reads a value from text and checks its range. On failure the value is unchanged.
  [[nodiscard]] std::optional<ParseError> parse(std::string_view text, const UnitSystem& units);
  // Takes over the value of the data link's source: the same type directly, others through text.
  [[nodiscard]] std::optional<ParseError> pull();

  void setWhere(SourceRange where) {
    where_ = std::move(where);
    isSet_ = true;
  }
  void linkTo(const AttributeBase* source) {
    source_ = source;
    isSet_ = true;
  }

  [[nodiscard]] virtual std::string typeName() const = 0;
  [[nodiscard]] virtual std::string print() const = 0;
  [[nodiscard]] virtual std::string printDefault() const = 0;
  // The value as one number where it is one (for monitors and the JSON summary).
  [[nodiscard]] virtual std::optional<double> number() const { return std::nullopt; }
  // The words allowed, for attributes that are a choice.
  [[nodiscard]] virtual std::vector<std::string> choices() const { return {}; }

 protected:
  [[nodiscard]] virtual std::optional<ParseError> parseValue(std::string_view text,
                                                             const ValueContext& context) = 0;
  // Takes the value of an attribute of the same type; false for another type.
  [[nodiscard]] virtual bool copyFrom(const AttributeBase& source) = 0;
  [[nodiscard]] virtual std::optional<std::string> rangeProblem() const = 0;

 private:
  AttributeOwner* owner_;
  std::string_view name_, doc_;
  AttributeInfo info_;
  SourceRange where_;
  const AttributeBase* source_ = nullptr;
  bool isSet_ = false;
};

namespace detail {

template <class T>
concept EnumValue = std::is_enum_v<T>;

// First number of a value that lies outside the range, as text.
std::optional<std::string> outside(std::span<const double> numbers, const AttributeInfo& info);

template <class T>
std::optional<std::string> outsideRange(const T& value, const AttributeInfo& info) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
    const double number = value;
    return outside({&number, 1}, info);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    return outside({value.data(), 3}, info);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return outside(value, info);
  } else if constexpr (std::is_same_v<T, std::vector<int>>) {
    const std::vector<double> numbers(value.begin(), value.end());
    return outside(numbers, info);
  } else {
    return std::nullopt;
  }
}

}  // namespace detail

template <class T>
class Attribute final : public AttributeBase {
 public:
  Attribute(AttributeOwner* owner, std::string_view name, T defaultValue, std::string_view doc,
            const AttributeInfo& info = {})
      : AttributeBase(owner, name, doc, info), value_(defaultValue), default_(defaultValue) {}

  operator const T&() const { return value_; }
  const T& operator*() const { return value_; }
  const T* operator->() const { return &value_; }
  [[nodiscard]] const T& value() const { return value_; }

  // For components: a computed output, or a value taken from elsewhere at load.
  void set(T value) { value_ = std::move(value); }

  [[nodiscard]] std::string typeName() const override { return ValueTraits<T>::typeName(); }
  [[nodiscard]] std::string print() const override { return ValueTraits<T>::print(value_); }
  [[nodiscard]] std::string printDefault() const override {
    return ValueTraits<T>::print(default_);
  }
  [[nodiscard]] std::optional<double> number() const override {
    if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(value_);
    return std::nullopt;
  }
  [[nodiscard]] std::vector<std::string> choices() const override {
    std::vector<std::string> words;
    if constexpr (detail::EnumValue<T>) {
      for (const auto& entry : EnumNames<T>::names) words.emplace_back(entry.second);
    }
    return words;
  }

 protected:
  std::optional<ParseError> parseValue(std::string_view text,
                                       const ValueContext& context) override {
    T parsed = default_;
    if (auto problem = ValueTraits<T>::parse(text, context, parsed)) return problem;
    if (auto problem = detail::outsideRange(parsed, info())) {
      return ParseError{0, text.size(), "value-range", *problem, ""};
    }
    value_ = std::move(parsed);
    return std::nullopt;
  }
  bool copyFrom(const AttributeBase& source) override {
    const auto* same = dynamic_cast<const Attribute<T>*>(&source);
    if (!same) return false;
    value_ = same->value_;
    return true;
  }
  std::optional<std::string> rangeProblem() const override {
    return detail::outsideRange(value_, info());
  }

 private:
  T value_, default_;
};

}  // namespace stroma
