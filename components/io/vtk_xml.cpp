// SPDX-License-Identifier: Apache-2.0
#include "components/io/vtk_xml.h"

#include <bit>
#include <charconv>
#include <cstring>

#include "core/xml_text.h"

namespace stroma::vtk {
namespace {

static_assert(std::endian::native == std::endian::little, "raw data are written little endian");

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// The XML text and, behind it, the arrays that its DataArray elements point into.
class File {
 public:
  explicit File(const char* type) : type_(type) {
    text_ = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type +
            "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + type +
            ">\n";
  }
  void add(const std::string& text) { text_ += text; }

  template <class T>
  void array(const char* type, const std::string& name, int components, std::span<const T> values) {
    text_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + xmlText(name) +
             "\" NumberOfComponents=\"" + std::to_string(components) +
             "\" format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
    const std::uint64_t bytes = values.size_bytes();
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data_.append(reinterpret_cast<const char*>(values.data()), bytes);
  }

  // Times and point data, which both kinds of file have alike.
  void addTime(double time) {
    text_ +=
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">" +
        number(time) + "</DataArray>\n</FieldData>\n";
  }
  void addPoints(const Picture& picture) {
    text_ += "<Points>\n";
    array<double>("Float64", "Points", 3,
                  {picture.points.empty() ? nullptr : picture.points.front().data(),
                   3 * picture.points.size()});
    text_ += "</Points>\n<PointData>\n";
    for (const Field& f : picture.fields) {
      array<double>("Float64", f.name, f.components, f.values);
    }
    text_ += "</PointData>\n";
  }
  [[nodiscard]] std::string finish() {
    return text_ + "</Piece>\n</" + type_ + ">\n<AppendedData encoding=\"raw\">\n_" + data_ +
           "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  const char* type_;
  std::string text_, data_;
};

// Elements as VTK lists them: all their points, and where each element's end.
class Cells {
 public:
  template <std::size_t N>
  void add(std::span<const std::array<Index, N>> elements, std::uint8_t type) {
    for (const auto& element : elements) {
      points_.insert(points_.end(), element.begin(), element.end());
      ends_.push_back(static_cast<std::int64_t>(points_.size()));
      types_.push_back(type);
    }
  }
  void addVertices(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<Index, 1> vertex{static_cast<Index>(i)};
      add(std::span<const std::array<Index, 1>>(&vertex, 1), 1);
    }
  }
  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  void write(File& file, bool withTypes) const {
    file.array<Index>("Int32", "connectivity", 1, points_);
    file.array<std::int64_t>("Int64", "offsets", 1, ends_);
    if (withTypes) file.array<std::uint8_t>("UInt8", "types", 1, types_);
  }

 private:
  std::vector<Index> points_;
  std::vector<std::int64_t> ends_;
  std::vector<std::uint8_t> types_;
};

// The format's cell type numbers.
constexpr std::uint8_t lineType = 3, triangleType = 5, quadType = 9, tetrahedronType = 10,
                       hexahedronType = 12;

std::string count(const char* name, std::size_t n) {
  return std::string(" ") + name + "=\"" + std::to_string(n) + "\"";
}

}  // namespace

bool isSurface(const Picture& p) {
  return p.tetrahedra.empty() && p.hexahedra.empty() && !(p.triangles.empty() && p.quads.empty());
}

std::string polyData(const Picture& p) {
  Cells vertices, lines, polygons;
  lines.add(p.edges, lineType);
  polygons.add(p.triangles, triangleType);
  polygons.add(p.quads, quadType);
  if (lines.size() + polygons.size() == 0) vertices.addVertices(p.points.size());
  File file("PolyData");
  file.addTime(p.time);
  file.add("<Piece" + count("NumberOfPoints", p.points.size()) +
           count("NumberOfVerts", vertices.size()) + count("NumberOfLines", lines.size()) +
           count("NumberOfPolys", polygons.size()) + ">\n");
  file.addPoints(p);
  file.add("<Verts>\n");
  vertices.write(file, false);
  file.add("</Verts>\n<Lines>\n");
  lines.write(file, false);
  file.add("</Lines>\n<Polys>\n");
  polygons.write(file, false);
  file.add("</Polys>\n");
  return file.finish();
}

std::string unstructuredGrid(const Picture& p) {
  Cells cells;
  cells.add(p.edges, lineType);
  cells.add(p.triangles, triangleType);
  cells.add(p.quads, quadType);
  cells.add(p.tetrahedra, tetrahedronType);
  cells.add(p.hexahedra, hexahedronType);
  if (cells.size() == 0) cells.addVertices(p.points.size());
  File file("UnstructuredGrid");
  file.addTime(p.time);
  file.add("<Piece" + count("NumberOfPoints", p.points.size()) +
           count("NumberOfCells", cells.size()) + ">\n");
  file.addPoints(p);
  file.add("<Cells>\n");
  cells.write(file, true);
  file.add("</Cells>\n");
  return file.finish();
}

std::string collection(std::span<const Frame> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const Frame& frame : frames) {
    text += "<DataSet timestep=\"" + number(frame.time) + "\" part=\"0\" file=\"" +
            xmlText(frame.file) + "\"/>\n";
  }
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace stroma::vtk
