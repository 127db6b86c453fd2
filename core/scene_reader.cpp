// SPDX-License-Identifier: Apache-2.0
#include "core/scene_reader.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>

#include "core/path.h"
#include "core/sofa_dialect.h"
#include "core/traverse.h"

namespace stroma {
namespace {

bool isComment(std::string_view attribute) {
  return attribute.starts_with('_') || attribute.starts_with("NO");
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Part of an attribute's text, as a place in the file.
SourceRange within(const SourceRange& whole, const ParseError& error) {
  SourceRange range = whole;
  if (!range || error.offset > range.length) return range;
  range.offset += error.offset;
  range.length = std::max<std::size_t>(1, std::min(error.length, whole.length - error.offset));
  return range;
}

// Child nodes and components of that name.
std::ptrdiff_t namesIn(const Node& node, const std::string& name) {
  const auto named = [&](const auto& item) { return item->name() == name; };
  return std::ranges::count_if(node.components(), named) +
         std::ranges::count_if(node.children(), named);
}

bool truthy(const std::string& text) {
  bool value = true;
  return ValueTraits<bool>::parse(text, {}, value) || value;
}

}  // namespace

// "Name", "Name2", ... whichever is free in the node.
// Links find the first of two, and checkpoints could not tell them apart.
void SceneReader::reportRepeatedName(const Node& node, const SceneAttribute& name) {
  if (namesIn(node, name.value) < 2) return;
  diagnostics_.error("name-repeated",
                     "the name '" + name.value + "' is used twice in node '" + node.path() + "'",
                     name.valueAt, "give each its own");
}

std::string SceneReader::freeName(const Node& node, const std::string& type) {
  const auto taken = [&](const std::string& name) { return namesIn(node, name) > 0; };
  int& number = named_[{&node, type}];  // goes on where the last of the type stopped
  std::string name;
  do {
    name = ++number == 1 ? type : type + std::to_string(number);
  } while (taken(name));
  return name;
}

void SceneReader::strict(std::string id, std::string message, SourceRange at, std::string hint) {
  diagnostics_.report({scene_.options().lenient ? Severity::warning : Severity::error,
                       std::move(id), std::move(message), std::move(at), std::move(hint)});
}

void SceneReader::read(const SceneElement& root, const std::vector<std::string>& overrides) {
  if (root.tag != "Node") {
    diagnostics_.error("root-not-node",
                       "the root element of a scene is Node, not '" + root.tag + "'", root.at);
    return;
  }
  readNode(root, scene_.root(), UnitSystem{});
  for (const std::string& assignment : overrides) override(assignment);
  forEachComponent(scene_.root(), [&](Component& c) {
    checkRequired(c);
    resolveLinks(c);
  });
  for (const PendingLink& pending : pending_) resolvePending(pending);
}

void SceneReader::readNode(const SceneElement& element, Node& node, UnitSystem units) {
  node.setWhere(element.at);
  const SceneAttribute* name = element.find("name");
  node.setName(name ? name->value : node.parent() ? freeName(*node.parent(), "Node") : "root");
  if (name && node.parent()) reportRepeatedName(*node.parent(), *name);
  if (const SceneAttribute* system = element.find("units")) {
    if (const auto parsed = UnitSystem::parse(system->value)) {
      units = *parsed;
    } else {
      diagnostics_.error("unit-system",
                         "Node '" + node.name() + "': 'units' " + stroma::quoted(system->value) +
                             " is not a length, a mass and a time",
                         system->valueAt, "for example \"mm g s\" or \"m kg s\"");
    }
  }
  for (const SceneAttribute& a : element.attributes) {
    if (a.name == "name" || isComment(a.name) || sofa::isIgnoredNodeAttribute(a.name)) continue;
    if (AttributeBase* attribute = node.attribute(a.name)) {
      setValue(node, *attribute, a.value, a.valueAt, units);
      const bool ofRoot =
          attribute == &node.dt || attribute == &node.time || attribute == &node.duration;
      if (ofRoot && node.parent()) {
        diagnostics_.warning(
            "attr-root-only",
            "Node '" + node.name() + "': '" + a.name + "' is read from the root node only",
            a.nameAt);
      }
    } else {
      const auto names = node.attributeAndLinkNames();
      strict("attr-unknown", "Node '" + node.name() + "': unknown attribute '" + a.name + "'",
             a.nameAt, didYouMean(a.name, names));
    }
  }
  for (const SceneElement& child : element.children) {
    if (child.tag == "Node") {
      const SceneAttribute* activated = child.find("activated");
      if (activated && !truthy(activated->value)) continue;
      readNode(child, node.addChild(), units);
    } else {
      readComponent(child, node, units);
    }
  }
}

void SceneReader::readRequiredPlugin(const SceneElement& element) {
  const SceneAttribute* list = element.find("pluginName");
  if (!list) list = element.find("name");
  if (!list) return;
  for (const std::string& name : words(list->value)) {
    if (name.starts_with("Sofa")) continue;  // its components are found by their names
    const ModuleManifest* module = scene_.modules().module(name);
    std::string problem;
    if (!module) {
      diagnostics_.warning("plugin-missing", "there is no plugin '" + name + "' on the search path",
                           list->valueAt);
    } else if (!scene_.modules().load(*module, scene_.registry(), problem)) {
      diagnostics_.error("plugin-refused", problem, list->valueAt);
    }
  }
}

const ComponentEntry* SceneReader::findType(std::string_view tag, const SceneElement& element) {
  const std::string_view name = sofa::currentName(tag);
  if (const ComponentEntry* entry = scene_.registry().find(name)) return entry;
  if (const ModuleManifest* module = scene_.modules().moduleOf(name)) {
    std::string problem;
    if (!scene_.modules().load(*module, scene_.registry(), problem)) {
      diagnostics_.error("plugin-refused", "cannot create '" + std::string(tag) + "': " + problem,
                         element.at);
      return nullptr;
    }
    if (const ComponentEntry* entry = scene_.registry().find(name)) return entry;
  }
  if (!sofa::isIgnoredElement(name)) {
    std::string hint = didYouMean(name, scene_.modules().componentNames());
    if (hint.empty()) hint = "`stroma components` lists those that the modules found here have";
    strict("type-unknown", "unknown component " + quoted(tag), element.at, std::move(hint));
  }
  return nullptr;
}

void SceneReader::readComponent(const SceneElement& element, Node& node, const UnitSystem& units) {
  std::string_view tag = element.tag;
  if (tag == "RequiredPlugin") return readRequiredPlugin(element);
  if (tag == "Object") {
    const SceneAttribute* type = element.find("type");
    if (!type) {
      diagnostics_.error("type-unknown", "an Object needs type=\"...\"", element.at);
      return;
    }
    tag = type->value;
  }
  for (const SceneElement& child : element.children) {
    diagnostics_.error("component-children",
                       "'" + element.tag + "' is a component: it holds no elements; put '" +
                           child.tag + "' beside it",
                       child.at);
  }
  const ComponentEntry* entry = findType(tag, element);
  if (!entry) return;
  Component& component = node.add(scene_.registry().create(*entry));
  component.setWhere(element.at);
  const SceneAttribute* name = element.find("name");
  component.setName(name ? name->value : freeName(node, entry->name));
  if (name) reportRepeatedName(node, *name);
  for (const SceneAttribute& a : element.attributes) {
    if (a.name == "name" || a.name == "type" || isComment(a.name)) continue;
    if (a.name == "template") {
      std::string data = a.value.substr(0, a.value.find(','));
      const bool matrix = data.starts_with("CompressedRowSparse") || data == "GraphScattered";
      if (!matrix && std::ranges::find(entry->dataTypes, data) == entry->dataTypes.end()) {
        diagnostics_.error("template",
                           component.describe() + ": there is no variant for '" + a.value +
                               "': this build has Vec3 only",
                           a.valueAt);
      }
    } else if (a.name == "src") {
      pending_.push_back({&component, nullptr, a.value, a.valueAt});
    } else if (a.name == "printLog") {
      component.verbose_ = truthy(a.value);
    } else {
      readAttribute(component, a, units);
    }
  }
}

void SceneReader::readAttribute(Component& component, const SceneAttribute& a,
                                const UnitSystem& units) {
  if (LinkBase* link = component.link(a.name)) {
    link->setText(a.value, a.valueAt);
    return;
  }
  AttributeBase* attribute = component.attribute(a.name);
  if (!attribute) {
    if (sofa::isIgnoredAttribute(component.type(), a.name)) return;
    const auto names = component.attributeAndLinkNames();
    std::string hint = didYouMean(a.name, names);
    strict("attr-unknown", component.describe() + ": unknown attribute '" + a.name + "'", a.nameAt,
           std::move(hint));
    return;
  }
  if (attribute->info().output) {
    diagnostics_.error("attr-output",
                       component.describe() + ": '" + a.name +
                           "' is computed by the component; it can be read but not set",
                       a.nameAt);
    return;
  }
  setValue(component, *attribute, a.value, a.valueAt, units);
}

void SceneReader::setValue(AttributeOwner& owner, AttributeBase& attribute, const std::string& text,
                           const SourceRange& at, const UnitSystem& units) {
  attribute.setWhere(at);
  // what is written later (an override) replaces an earlier link
  std::erase_if(pending_, [&](const PendingLink& p) { return p.attribute == &attribute; });
  attribute.linkTo(nullptr);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start != std::string::npos && text[start] == '@') {
    if (auto* component = dynamic_cast<Component*>(&owner)) {
      pending_.push_back({component, &attribute, text, at});
    } else {
      diagnostics_.error("link-node", owner.describe() + ": attributes of nodes cannot be links",
                         at);
    }
    return;
  }
  if (auto error = attribute.parse(text, units)) {
    diagnostics_.error(
        error->id,
        owner.describe() + ": '" + std::string(attribute.name()) + "': " + error->message,
        within(at, *error), error->hint);
    if (auto* component = dynamic_cast<Component*>(&owner)) component->failed_ = true;
  }
}

void SceneReader::checkRequired(const Component& component) {
  for (const AttributeBase* a : component.attributes()) {
    if (!a->info().required || a->isSet()) continue;
    // src may still provide it
    const bool mayCome = std::ranges::any_of(
        pending_, [&](const PendingLink& p) { return p.component == &component && !p.attribute; });
    if (mayCome) continue;
    diagnostics_.error("attr-required",
                       component.describe() + ": '" + std::string(a->name()) + "' is required",
                       component.where(), std::string(a->doc()));
    const_cast<Component&>(component).failed_ = true;
  }
}

void SceneReader::override(const std::string& assignment) {
  const auto source = std::make_shared<SourceText>("--set", assignment);
  const SourceRange whole{source, 0, assignment.size()};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    diagnostics_.error("set-syntax", "expected /path/to/component.attribute=value", whole);
    return;
  }
  const std::string path = assignment.substr(0, equals), value = assignment.substr(equals + 1);
  const SourceRange pathAt{source, 0, equals}, valueAt{source, equals + 1, value.size()};
  const PathParts parts = splitPath(path);
  if (!path.starts_with('/') || parts.attribute.empty()) {
    diagnostics_.error("set-syntax", "expected /path/to/component.attribute=value", pathAt);
    return;
  }
  std::string problem, hint;
  const PathTarget target = resolvePath(scene_.root(), nullptr, parts.object, problem, hint);
  if (!target) {
    diagnostics_.error("set-path", problem, pathAt, hint);
    return;
  }
  if (target.component) {
    readAttribute(*target.component,
                  {std::string(parts.attribute),
                   value,
                   {source, equals - parts.attribute.size(), parts.attribute.size()},
                   valueAt},
                  UnitSystem{});
  } else if (parts.attribute == "activated" || parts.attribute == "units") {
    diagnostics_.error("set-path",
                       "'" + std::string(parts.attribute) +
                           "' decides how the scene is read: it cannot be set afterwards",
                       pathAt, "edit the scene");
  } else if (AttributeBase* attribute = target.node->attribute(parts.attribute)) {
    setValue(*target.node, *attribute, value, valueAt, UnitSystem{});
  } else {
    diagnostics_.error(
        "attr-unknown",
        target.node->describe() + ": unknown attribute '" + std::string(parts.attribute) + "'",
        pathAt, didYouMean(parts.attribute, target.node->attributeAndLinkNames()));
  }
}

std::string SceneReader::candidates(const LinkBase& link, const Component& self) {
  std::string list;
  int count = 0;
  forEachComponent(scene_.root(), [&](Component& c) {
    if (&c == &self || !link.accepts(c)) return;
    if (++count <= 5) list += (list.empty() ? "@" : ", @") + c.path();
  });
  if (count == 0) return "the scene has no " + std::string(link.role());
  return "candidates: " + list + (count > 5 ? ", ..." : "");
}

void SceneReader::resolveLinks(Component& component) {
  for (LinkBase* link : component.links()) {
    link->isSet() ? resolveExplicit(component, *link) : resolveImplicit(component, *link);
  }
}

void SceneReader::resolveExplicit(Component& component, LinkBase& link) {
  const std::string who = component.describe() + ": '" + std::string(link.name()) + "' ";
  const std::string role(link.role());
  std::vector<Component*> targets;
  const auto fail = [&](std::string id, const std::string& message, std::string hint) {
    component.failed_ = true;
    diagnostics_.error(std::move(id), who + message, link.where(), std::move(hint));
  };
  const std::vector<std::string> tokens = words(link.text());
  if (tokens.size() != 1 && !link.info().many) {
    return fail("link-count", "takes one link, not " + std::to_string(tokens.size()), "");
  }
  for (const std::string& token : tokens) {
    if (!token.starts_with('@')) {
      return fail("link-syntax", "is a link to a " + role + ": it begins with '@'",
                  "did you mean '@" + token + "'?");
    }
    const std::string_view path = std::string_view(token).substr(1);
    const PathParts parts = splitPath(path);
    std::string problem, hint;
    PathTarget target;
    if (!parts.attribute.empty()) {
      // a name with a dot in it, or an attribute where a component is wanted
      target = resolvePath(component.node(), &component, path, problem, hint);
      if (!target) {
        const PathTarget owner =
            resolvePath(component.node(), &component, parts.object, problem, hint);
        const bool fits = owner.component && link.accepts(*owner.component);
        return fail("link-attr", "links to '" + token + "', an attribute; a " + role + " is wanted",
                    fits ? "did you mean '@" + std::string(parts.object) + "'?" : "");
      }
    } else {
      target = resolvePath(component.node(), &component, path, problem, hint);
    }
    if (!target)
      return fail("link-missing", "links to '" + token + "': " + problem,
                  hint.empty() ? candidates(link, component) : hint);
    if (!target.component) {
      std::vector<Component*> found;
      for (const auto& c : target.node->components()) {
        if (c.get() != &component && link.accepts(*c)) found.push_back(c.get());
      }
      if (found.size() != 1) {
        return fail("link-type",
                    "links to node '" + target.node->path() + "', which has " +
                        (found.empty() ? "no " : "several components of role ") + role,
                    candidates(link, component));
      }
      target.component = found.front();
    } else if (!link.accepts(*target.component)) {
      return fail(
          "link-type",
          "links to '" + token + "', a " + target.component->type() + "; a " + role + " is wanted",
          candidates(link, component));
    }
    targets.push_back(target.component);
  }
  link.setTargets(targets);
}

void SceneReader::resolveImplicit(Component& component, LinkBase& link) {
  std::vector<Component*> found;
  Node* node = link.lookup() == Lookup::parent ? component.node().parent() : &component.node();
  if (link.lookup() != Lookup::explicitOnly) {
    for (; node && found.empty(); node = node->parent()) {
      for (const auto& c : node->components()) {
        if (c.get() != &component && link.accepts(*c)) found.push_back(c.get());
      }
      if (link.lookup() == Lookup::sameNode) break;
    }
  }
  const std::string who = component.describe() + ": '" + std::string(link.name()) + "' ";
  if (found.size() > 1 && !link.info().many) {
    component.failed_ = true;
    diagnostics_.error(
        "link-ambiguous",
        who + "could be several components: write " + std::string(link.name()) + "=\"@name\"",
        component.where(), candidates(link, component));
    return;
  }
  if (found.empty() && link.info().required) {
    const char* where = link.lookup() == Lookup::explicitOnly ? "is required"
                        : link.lookup() == Lookup::sameNode   ? "is not in this node"
                        : link.lookup() == Lookup::parent     ? "is not in the nodes above"
                                                              : "is not in this node or above";
    component.failed_ = true;
    diagnostics_.error("link-missing", who + "(a " + std::string(link.role()) + ") " + where,
                       component.where(), candidates(link, component));
    return;
  }
  link.setTargets(found);
}

void SceneReader::resolvePending(const PendingLink& pending) {
  Component& component = *pending.component;
  const std::string what = pending.attribute ? std::string(pending.attribute->name()) : "src";
  const std::string who = component.describe() + ": '" + what + "' ";
  const auto fail = [&](std::string id, const std::string& message, std::string hint) {
    component.failed_ = true;
    diagnostics_.error(std::move(id), who + message, pending.at, std::move(hint));
  };
  const std::vector<std::string> tokens = words(pending.text);
  if (tokens.size() != 1 || !tokens[0].starts_with('@') || tokens[0] == "@") {
    return fail("link-syntax",
                "is not one link such as '@component" +
                    std::string(pending.attribute ? ".attribute'" : "'"),
                "");
  }
  const std::string_view path = std::string_view(tokens[0]).substr(1);
  const PathParts parts = pending.attribute ? splitPath(path) : PathParts{path, {}};
  if (pending.attribute && parts.attribute.empty()) {
    return fail("link-syntax",
                "links to '" + tokens[0] + "': name an attribute, '@component.attribute'", "");
  }
  std::string problem, hint;
  const PathTarget target = resolvePath(component.node(), &component, parts.object, problem, hint);
  if (!target) return fail("link-missing", "links to '" + tokens[0] + "': " + problem, hint);
  const AttributeOwner& owner =
      target.component ? static_cast<const AttributeOwner&>(*target.component) : *target.node;
  if (pending.attribute) {
    const AttributeBase* source = owner.attribute(parts.attribute);
    if (!source) {
      std::vector<std::string> names;
      for (const AttributeBase* a : owner.attributes()) names.emplace_back(a->name());
      return fail("link-attr",
                  "links to '" + tokens[0] + "': " + owner.describe() + " has no attribute '" +
                      std::string(parts.attribute) + "'",
                  didYouMean(parts.attribute, names));
    }
    pending.attribute->linkTo(source);
    return;
  }
  if (!target.component) {
    return fail("link-type", "links to '" + tokens[0] + "', a node; a component is wanted", "");
  }
  // src never overrides what the element writes itself
  int taken = 0;
  for (const AttributeBase* source : owner.attributes()) {
    if (!source->info().autolink) continue;
    AttributeBase* own = component.attribute(source->name());
    if (!own || own->info().output || own->isSet()) continue;
    own->linkTo(source);
    ++taken;
  }
  if (taken == 0) {
    diagnostics_.warning("src-empty", who + "takes nothing over from " + owner.describe(),
                         pending.at);
  }
}

}  // namespace stroma
