// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/page_bundle.h"

#include <array>
#include <boost/dll/runtime_symbol_info.hpp>
#include <fstream>
#include <sstream>
#include <utility>

namespace stroma::viewer {
namespace {
namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> types = {
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".css", "text/css; charset=utf-8"},
     {".svg", "image/svg+xml"},
     {".png", "image/png"},
     {".txt", "text/plain; charset=utf-8"}}};

std::string_view typeOf(const fs::path& file) {
  for (const auto& [extension, type] : types) {
    if (file.extension() == extension) return type;
  }
  return {};
}

}  // namespace

fs::path PageBundle::standardFolder() {
  const fs::path library = boost::dll::this_line_location().parent_path().string();
  return (library / "../../share/stroma/viewer").lexically_normal();
}

std::string PageBundle::read(const fs::path& folder) {
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    const std::string_view type = typeOf(entry.path());
    if (type.empty() || !entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    if (!in) return "cannot read '" + entry.path().string() + "'";
    files_["/" + entry.path().filename().string()] = {std::move(bytes).str(), type};
  }
  if (find("/")) return "";
  return "there is no page in '" + folder.string() + "' (index.html)";
}

const PageFile* PageBundle::find(std::string_view path) const {
  const auto at = files_.find(path == "/" ? "/index.html" : path);
  return at == files_.end() ? nullptr : &at->second;
}

}  // namespace stroma::viewer
