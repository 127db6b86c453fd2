// SPDX-License-Identifier: Apache-2.0
#include "core/attribute_owner.h"

namespace stroma {

LinkBase::LinkBase(AttributeOwner* owner, std::string_view name, std::string_view doc,
                   Lookup lookup, const LinkInfo& info)
    : name_(name), doc_(doc), lookup_(lookup), info_(info) {
  owner->links_.push_back(this);
}

bool LinkBase::answersTo(std::string_view wanted) const {
  return stroma::answersTo(wanted, name_, info_.aliases);
}

AttributeBase* AttributeOwner::attribute(std::string_view name) const {
  for (AttributeBase* a : attributes_) {
    if (a->answersTo(name)) return a;
  }
  return nullptr;
}

LinkBase* AttributeOwner::link(std::string_view name) const {
  for (LinkBase* l : links_) {
    if (l->answersTo(name)) return l;
  }
  return nullptr;
}

std::vector<std::string> AttributeOwner::attributeAndLinkNames() const {
  std::vector<std::string> names;
  for (const AttributeBase* a : attributes_) {
    if (!a->info().output) names.emplace_back(a->name());
  }
  for (const LinkBase* l : links_) names.emplace_back(l->name());
  return names;
}

}  // namespace stroma
