// SPDX-License-Identifier: Apache-2.0
#include "core/node.h"

#include "core/scene.h"

namespace stroma {

Node::Node(Scene& scene, Node* parent) : scene_(&scene), parent_(parent) {}

const Vec3& Node::gravityHere() const {
  const Node* node = this;
  while (!node->gravity.isSet() && node->parent_) node = node->parent_;
  return node->gravity;
}

Node& Node::addChild() {
  children_.push_back(std::make_unique<Node>(*scene_, this));
  return *children_.back();
}

Component& Node::add(std::unique_ptr<Component> component) {
  component->node_ = this;
  components_.push_back(std::move(component));
  return *components_.back();
}

std::string Node::describe() const { return "Node '" + name() + "'"; }

std::string Node::path() const {
  if (!parent_) return "/";
  const std::string above = parent_->path();
  return above == "/" ? above + name() : above + "/" + name();
}

}  // namespace stroma
