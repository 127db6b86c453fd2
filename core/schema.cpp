// SPDX-License-Identifier: Apache-2.0
#include "core/schema.h"

#include <cmath>
#include <iterator>
#include <sstream>

#include "core/interfaces/animation_loop.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/linear_solver.h"
#include "core/interfaces/mapping.h"
#include "core/interfaces/mass.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/interfaces/projective_constraint.h"
#include "core/scene.h"
#include "core/xml_text.h"

namespace stroma {
namespace {

template <class... Roles>
std::string namesOfRoles(const Component& component) {
  std::string names;
  const auto add = [&]<class Role>() {
    if (dynamic_cast<const Role*>(&component)) {
      names += (names.empty() ? "" : ", ") + std::string(Role::role);
    }
  };
  (add.template operator()<Roles>(), ...);
  return names.empty() ? std::string(Component::role) : names;
}

std::string number(double value) { return ValueTraits<double>::print(value); }

std::string range(const AttributeInfo& info) {
  const bool low = std::isfinite(info.min), high = std::isfinite(info.max);
  std::string text;
  if (low) text += (info.exclusiveMin ? "> " : ">= ") + number(info.min);
  if (high)
    text += (low ? " and " : "") + std::string(info.exclusiveMax ? "< " : "<= ") + number(info.max);
  return text;
}

std::string lookupText(const LinkBase& link) {
  switch (link.lookup()) {
    case Lookup::explicitOnly:
      return link.info().required ? "must be written" : "none unless written";
    case Lookup::sameNode:
      return "else the one in its node";
    case Lookup::nearest:
      return "else the nearest, in its node or above";
    case Lookup::parent:
      return "else the nearest above its node";
  }
  return "";
}

std::string linkSummary(const LinkBase& link) {
  return "link to " + std::string(link.info().many ? "several " : "a ") + std::string(link.role()) +
         ", " + lookupText(link) + (link.info().required ? "" : ", optional");
}

std::string otherNames(std::string_view aliases) {
  return aliases.empty() ? "" : " Also: " + std::string(aliases) + ".";
}

std::string flags(const AttributeInfo& info) {
  std::string text;
  if (info.required) text += " Required.";
  if (info.runtime) text += " May change while the scene runs.";
  if (info.autolink) text += " Taken over by src.";
  return text;
}

// One entry of a reference: name, kind and help, whatever it is laid out as.
struct Row {
  std::string name, summary, help;
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

std::vector<Section> sections(const Component& component) {
  Section given{"Attributes", {}}, outputs{"Outputs, for others to link to", {}};
  Section links{"Links", {}}, limiters{"Limiters", {}};
  for (const AttributeBase* a : component.attributes()) {
    (a->info().output ? outputs : given)
        .rows.push_back({std::string(a->name()), attributeSummary(*a),
                         std::string(a->doc()) + flags(a->info()) + otherNames(a->info().aliases)});
  }
  for (const LinkBase* l : component.links()) {
    links.rows.push_back({std::string(l->name()), linkSummary(*l),
                          std::string(l->doc()) + otherNames(l->info().aliases)});
  }
  for (const Limiter* l : component.limiters()) {
    limiters.rows.push_back(
        {std::string(l->name()), "counted in the run's summary", std::string(l->doc())});
  }
  return {given, outputs, links, limiters};
}

std::vector<std::pair<std::string, std::string>> facts(const Component& component,
                                                       const ComponentEntry& entry) {
  std::vector<std::pair<std::string, std::string>> list = {{"Role", rolesOf(component)},
                                                           {"Module", entry.origin}};
  std::string aliases;
  for (const std::string& alias : entry.aliases) aliases += (aliases.empty() ? "" : ", ") + alias;
  if (!aliases.empty()) list.emplace_back("Also named", aliases);
  if (!entry.domain.empty()) list.emplace_back("Domain", entry.domain);
  if (!entry.example.empty()) list.emplace_back("Example", entry.example);
  return list;
}

// Breaks text at blanks so that lines stay below 80 columns.
std::string wrapped(const std::string& text, const std::string& indent) {
  std::istringstream stream(text);
  std::string out, line = indent, word;
  while (stream >> word) {
    if (line.size() > indent.size() && line.size() + word.size() + 1 > 80) {
      out += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
  }
  return line.size() > indent.size() ? out + line + "\n" : out;
}

std::vector<std::string> splitNames(std::string_view names) {
  std::istringstream stream{std::string(names)};
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

class XsdWriter {
 public:
  std::string write(Scene& scene) {
    out_ =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n"
        "  <xs:element name=\"Node\" type=\"Node\"/>\n";
    // a value, a link to another attribute, or a parameter of an include
    pattern("number", "\\s*([-+]?[.0-9]|@|[$]\\{)(.|\\s)*");
    pattern("numbers", "\\s*|\\s*([-+]?[.0-9]|@|[$]\\{)(.|\\s)*");
    pattern("truth", "\\s*([tTfF0-9]|@|[$]\\{).*");
    pattern("link", "\\s*(@|[$]\\{)(.|\\s)*");
    nodeType(scene);
    for (const auto& [name, entry] : scene.registry().entries()) component(scene, entry);
    include();
    return out_ + "</xs:schema>\n";
  }

 private:
  void pattern(const std::string& name, const std::string& expression) {
    out_ += "  <xs:simpleType name=\"" + name +
            "\"><xs:restriction base=\"xs:string\"><xs:pattern value=\"" + expression +
            "\"/></xs:restriction></xs:simpleType>\n";
  }

  void documentation(const std::string& indent, const std::string& text) {
    out_ += indent + "<xs:annotation><xs:documentation>" + xmlText(text) +
            "</xs:documentation></xs:annotation>\n";
  }

  void nodeType(Scene& scene) {
    out_ +=
        "  <xs:complexType name=\"Node\">\n"
        "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n"
        "      <xs:element name=\"Node\" type=\"Node\"/>\n"
        "      <xs:element name=\"include\" type=\"include\"/>\n"
        "      <xs:element name=\"RequiredPlugin\"><xs:complexType>\n"
        "        <xs:attribute name=\"name\"/><xs:attribute name=\"pluginName\"/>\n"
        "      </xs:complexType></xs:element>\n";
    for (const auto& [name, entry] : scene.registry().entries()) {
      for (const std::string& tag : tags(entry)) {
        out_ += "      <xs:element name=\"" + tag + "\" type=\"" + name + "\"/>\n";
      }
    }
    out_ += "    </xs:choice>\n    <xs:attribute name=\"name\" type=\"xs:string\"/>\n";
    attributes(scene.root());
    out_ += "  </xs:complexType>\n";
  }

  static std::vector<std::string> tags(const ComponentEntry& entry) {
    std::vector<std::string> tags = entry.aliases;
    tags.insert(tags.begin(), entry.name);
    return tags;
  }

  void component(Scene& scene, const ComponentEntry& entry) {
    const auto prototype = scene.registry().create(entry);
    out_ += "  <xs:complexType name=\"" + entry.name + "\">\n";
    documentation("    ", entry.doc);
    for (const char* common : {"name", "template", "src", "printLog", "tags", "listening"}) {
      if (prototype->attribute(common) || prototype->link(common)) continue;
      out_ += "    <xs:attribute name=\"" + std::string(common) + "\" type=\"xs:string\"/>\n";
    }
    attributes(*prototype);
    for (const LinkBase* link : prototype->links()) {
      const std::string help = std::string(link->doc()) + " (" + linkSummary(*link) + ")";
      named(std::string(link->name()), link->info().aliases, "link", {}, help);
    }
    out_ += "  </xs:complexType>\n";
  }

  void attributes(const AttributeOwner& owner) {
    for (const AttributeBase* a : owner.attributes()) {
      if (a->info().output) continue;
      named(std::string(a->name()), a->info().aliases, typeOf(*a), a->choices(),
            std::string(a->doc()) + " (" + attributeSummary(*a) + ")");
    }
  }

  static std::string typeOf(const AttributeBase& attribute) {
    const std::string type = attribute.typeName();
    if (type == "true or false") return "truth";
    if (type == "number" || type == "whole number") return "number";
    if (type.ends_with("numbers") || type.starts_with("list of")) return "numbers";
    return "xs:string";
  }

  // The attribute under its own and its other names.
  void named(const std::string& name, std::string_view aliases, const std::string& type,
             const std::vector<std::string>& choices, const std::string& help) {
    std::vector<std::string> names = splitNames(aliases);
    names.insert(names.begin(), name);
    for (const std::string& n : names) {
      out_ += "    <xs:attribute name=\"" + n + "\"" +
              (choices.empty() ? " type=\"" + type + "\"" : "") + ">\n";
      documentation("      ", n == name ? help : "Other name of " + name + ": " + help);
      if (!choices.empty()) choice(choices);
      out_ += "    </xs:attribute>\n";
    }
  }

  void choice(const std::vector<std::string>& words) {
    out_ +=
        "      <xs:simpleType><xs:union memberTypes=\"link\"><xs:simpleType>"
        "<xs:restriction base=\"xs:string\">\n";
    for (const std::string& word : words) {
      out_ += "        <xs:enumeration value=\"" + xmlText(word) + "\"/>\n";
    }
    out_ += "      </xs:restriction></xs:simpleType></xs:union></xs:simpleType>\n";
  }

  // an include may set any attribute of what it includes
  void include() {
    out_ +=
        "  <xs:complexType name=\"include\">\n"
        "    <xs:attribute name=\"href\" type=\"xs:string\" use=\"required\"/>\n"
        "    <xs:anyAttribute processContents=\"skip\"/>\n"
        "  </xs:complexType>\n";
  }

  std::string out_;
};

}  // namespace

std::string rolesOf(const Component& component) {
  return namesOfRoles<AnimationLoop, ForceField, Integrator, LinearSolver, Mapping, Mass,
                      MechanicalState, Mesh, Topology, Observer, ProjectiveConstraint>(component);
}

std::string attributeSummary(const AttributeBase& attribute) {
  const AttributeInfo& info = attribute.info();
  std::string text = attribute.typeName();
  if (!info.unit.empty()) text += ", " + std::string(info.unit);
  if (const std::string bounds = range(info); !bounds.empty()) text += ", " + bounds;
  if (info.output || info.required) return text;
  const std::string standard = attribute.printDefault();
  return text + ", default " + (standard.empty() ? "empty" : standard);
}

std::string referenceText(const Registry& registry, const ComponentEntry& entry) {
  const auto component = registry.create(entry);
  std::string text = entry.name + "\n" + wrapped(entry.doc, "  ");
  for (const auto& [name, value] : facts(*component, entry)) {
    text += wrapped(name + ": " + value, "  ");
  }
  for (const Section& section : sections(*component)) {
    if (section.rows.empty()) continue;
    text += "\n" + section.title + "\n";
    for (const Row& row : section.rows) {
      text += "  " + row.name + "  (" + row.summary + ")\n" + wrapped(row.help, "      ");
    }
  }
  return text;
}

std::string referenceMarkdown(const Registry& registry, const ComponentEntry& entry) {
  const auto component = registry.create(entry);
  std::string text = "# " + entry.name + "\n\n" + entry.doc + "\n\n";
  for (const auto& [name, value] : facts(*component, entry)) {
    text += "* **" + name + "**: " + value + "\n";
  }
  for (const Section& section : sections(*component)) {
    if (section.rows.empty()) continue;
    text += "\n## " + section.title + "\n\n| name | value | meaning |\n|---|---|---|\n";
    for (const Row& row : section.rows) {
      text += "| `" + row.name + "` | " + cell(row.summary) + " | " + cell(row.help) + " |\n";
    }
  }
  return text;
}

std::string schemaXsd(Scene& scene) { return XsdWriter().write(scene); }

}  // namespace stroma
