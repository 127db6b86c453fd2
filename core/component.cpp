// SPDX-License-Identifier: Apache-2.0
#include "core/component.h"

#include "core/node.h"
#include "core/scene.h"

namespace stroma {

Limiter::Limiter(Component* owner, std::string_view name, std::string_view doc)
    : name_(name), doc_(doc) {
  owner->limiters_.push_back(this);
}

Scene& Component::scene() const { return node_->scene(); }

std::string Component::describe() const { return type_ + " '" + name() + "'"; }

std::string Component::path() const {
  const std::string above = node_->path();
  return above == "/" ? above + name() : above + "/" + name();
}

void Component::error(std::string id, std::string message, std::string hint) {
  failed_ = true;
  scene().diagnostics().error(std::move(id), describe() + ": " + message, where(), std::move(hint));
}

void Component::error(const AttributeBase& attribute, std::string id, std::string message,
                      std::string hint) {
  failed_ = true;
  scene().diagnostics().error(std::move(id),
                              describe() + ": '" + std::string(attribute.name()) + "' " + message,
                              attribute.where() ? attribute.where() : where(), std::move(hint));
}

void Component::error(const LinkBase& link, std::string id, std::string message, std::string hint) {
  failed_ = true;
  scene().diagnostics().error(std::move(id),
                              describe() + ": '" + std::string(link.name()) + "' " + message,
                              link.where() ? link.where() : where(), std::move(hint));
}

void Component::warning(std::string id, std::string message, std::string hint) {
  warned_ = true;
  scene().diagnostics().warning(std::move(id), describe() + ": " + message, where(),
                                std::move(hint));
}

void Component::note(std::string id, std::string message) {
  scene().diagnostics().note(std::move(id), describe() + ": " + message, where());
}

}  // namespace stroma
