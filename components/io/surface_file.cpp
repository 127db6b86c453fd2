// SPDX-License-Identifier: Apache-2.0
#include "components/io/surface_file.h"

#include <bit>
#include <charconv>

namespace stroma {
namespace {

static_assert(std::endian::native == std::endian::little, "binary meshes are little endian");

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string objFile(ConstVec3Span positions, std::span<const Triangle> triangles) {
  std::string out;
  for (const Vec3& x : positions) {
    out += "v " + number(x.x()) + " " + number(x.y()) + " " + number(x.z()) + "\n";
  }
  for (const Triangle& t : triangles) {
    out += "f";
    for (const Index i : t) out += " " + std::to_string(i + 1);
    out += "\n";
  }
  return out;
}

std::string plyFile(ConstVec3Span positions, std::span<const Triangle> triangles) {
  std::string out =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(positions.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& x : positions) {
    for (const double coordinate : x) append(out, coordinate);
  }
  for (const Triangle& t : triangles) {
    append<std::uint8_t>(out, 3);
    for (const Index i : t) append(out, i);
  }
  return out;
}

std::string stlFile(ConstVec3Span positions, std::span<const Triangle> triangles) {
  std::string out(80, ' ');  // a free header
  append(out, static_cast<std::uint32_t>(triangles.size()));
  const auto appendVector = [&](const Vec3& v) {
    for (const double coordinate : v) append(out, static_cast<float>(coordinate));
  };
  for (const Triangle& t : triangles) {
    const Vec3 &a = positions[static_cast<std::size_t>(t[0])],
               &b = positions[static_cast<std::size_t>(t[1])],
               &c = positions[static_cast<std::size_t>(t[2])];
    appendVector((b - a).cross(c - a).normalized());
    appendVector(a);
    appendVector(b);
    appendVector(c);
    append<std::uint16_t>(out, 0);  // attribute bytes
  }
  return out;
}

}  // namespace

std::string surfaceFile(SurfaceFormat format, ConstVec3Span positions,
                        std::span<const Triangle> triangles) {
  switch (format) {
    case SurfaceFormat::obj:
      return objFile(positions, triangles);
    case SurfaceFormat::ply:
      return plyFile(positions, triangles);
    case SurfaceFormat::stl:
      break;
  }
  return stlFile(positions, triangles);
}

}  // namespace stroma
