// SPDX-License-Identifier: Apache-2.0
// The files of the built page, read once into memory: nothing else is ever served.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace stroma::viewer {

struct PageFile {
  std::string bytes;
  std::string_view type;  // MIME
};

class PageBundle {
 public:
  // Reads all files directly in the folder. Returns what is wrong, or "".
  [[nodiscard]] std::string read(const std::filesystem::path& folder);
  // By the path of a request ("/" is index.html); null when the bundle has none.
  [[nodiscard]] const PageFile* find(std::string_view path) const;

  // Where the page lies beside this library, built or installed: ../../share/stroma/viewer.
  [[nodiscard]] static std::filesystem::path standardFolder();

 private:
  std::map<std::string, PageFile, std::less<>> files_;
};

}  // namespace stroma::viewer
