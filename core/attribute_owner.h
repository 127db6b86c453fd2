// SPDX-License-Identifier: Apache-2.0
// What nodes and components share: a name, a place in the scene file, attributes and links.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/attribute.h"
#include "core/link.h"

namespace stroma {

// True when `wanted` is the name or one of the aliases (separated by blanks).
[[nodiscard]] bool answersTo(std::string_view wanted, std::string_view name,
                             std::string_view aliases);

class AttributeOwner {
 public:
  AttributeOwner() = default;
  virtual ~AttributeOwner() = default;
  AttributeOwner(const AttributeOwner&) = delete;
  AttributeOwner& operator=(const AttributeOwner&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  void setName(std::string name) { name_ = std::move(name); }
  // Position of the element in the scene file.
  [[nodiscard]] const SourceRange& where() const { return where_; }
  void setWhere(SourceRange where) { where_ = std::move(where); }

  [[nodiscard]] std::span<AttributeBase* const> attributes() const { return attributes_; }
  [[nodiscard]] std::span<LinkBase* const> links() const { return links_; }
  // By name or alias; null when there is none.
  [[nodiscard]] AttributeBase* attribute(std::string_view name) const;
  [[nodiscard]] LinkBase* link(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> attributeAndLinkNames() const;

  // "MLSForceField 'elasticity'", for messages.
  [[nodiscard]] virtual std::string describe() const = 0;
  // Absolute path in the scene, "/cornea/elasticity".
  [[nodiscard]] virtual std::string path() const = 0;

 private:
  friend class AttributeBase;
  friend class LinkBase;
  std::string name_;
  SourceRange where_;
  std::vector<AttributeBase*> attributes_;
  std::vector<LinkBase*> links_;
};

}  // namespace stroma
