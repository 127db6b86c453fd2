// SPDX-License-Identifier: Apache-2.0
// Links: checked references from a component to another, resolved once after the whole scene is
// read, so the order of elements does not matter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/source.h"

namespace stroma {

class AttributeOwner;
class Component;

// Where a link that the scene does not write is looked for.
enum class Lookup {
  explicitOnly,  // nowhere
  sameNode,      // the component's own node
  nearest,       // its node, then the ancestors
  parent,        // the parent of its node, then the ancestors
};

struct LinkInfo {
  bool required = true;           // an unresolved link stops the load
  bool many = false;              // several targets, separated by blanks
  std::string_view aliases = "";  // other accepted names, separated by blanks
};

class LinkBase {
 public:
  LinkBase(AttributeOwner* owner, std::string_view name, std::string_view doc, Lookup lookup,
           const LinkInfo& info);
  virtual ~LinkBase() = default;
  LinkBase(const LinkBase&) = delete;
  LinkBase& operator=(const LinkBase&) = delete;

  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] std::string_view doc() const { return doc_; }
  [[nodiscard]] Lookup lookup() const { return lookup_; }
  [[nodiscard]] const LinkInfo& info() const { return info_; }
  [[nodiscard]] bool answersTo(std::string_view name) const;
  [[nodiscard]] const SourceRange& where() const { return where_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool isSet() const { return !text_.empty(); }

  void setText(std::string text, SourceRange where) {
    text_ = std::move(text);
    where_ = std::move(where);
  }

  // The role the target must play, for messages.
  [[nodiscard]] virtual std::string_view role() const = 0;
  [[nodiscard]] virtual bool accepts(Component& candidate) const = 0;
  virtual void setTargets(const std::vector<Component*>& targets) = 0;
  [[nodiscard]] const std::vector<Component*>& components() const { return components_; }

 protected:
  std::vector<Component*> components_;

 private:
  std::string_view name_, doc_;
  Lookup lookup_;
  LinkInfo info_;
  std::string text_;
  SourceRange where_;
};

// T is an interface or component class with `static constexpr std::string_view role`.
template <class T>
class LinkList : public LinkBase {
 public:
  LinkList(AttributeOwner* owner, std::string_view name, std::string_view doc, Lookup lookup,
           LinkInfo info = {})
      : LinkBase(owner, name, doc, lookup, [&] {
          info.many = true;
          return info;
        }()) {}
  [[nodiscard]] std::string_view role() const override { return T::role; }
  [[nodiscard]] bool accepts(Component& c) const override { return dynamic_cast<T*>(&c); }
  void setTargets(const std::vector<Component*>& targets) override {
    components_ = targets;
    targets_.clear();
    for (Component* c : targets) targets_.push_back(dynamic_cast<T*>(c));
  }
  [[nodiscard]] const std::vector<T*>& targets() const { return targets_; }

 private:
  std::vector<T*> targets_;
};

template <class T>
class Link final : public LinkBase {
 public:
  Link(AttributeOwner* owner, std::string_view name, std::string_view doc, Lookup lookup,
       const LinkInfo& info = {})
      : LinkBase(owner, name, doc, lookup, info) {}
  [[nodiscard]] std::string_view role() const override { return T::role; }
  [[nodiscard]] bool accepts(Component& c) const override { return dynamic_cast<T*>(&c); }
  void setTargets(const std::vector<Component*>& targets) override {
    components_ = targets;
    target_ = targets.empty() ? nullptr : dynamic_cast<T*>(targets.front());
  }
  [[nodiscard]] T* get() const { return target_; }
  T& operator*() const { return *target_; }
  T* operator->() const { return target_; }
  explicit operator bool() const { return target_ != nullptr; }

 private:
  T* target_ = nullptr;
};

}  // namespace stroma
