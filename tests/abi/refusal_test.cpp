// SPDX-License-Identifier: Apache-2.0
// Plugins built for another core are refused with a text that says why, before any of their code
// runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/json.h"
#include "core/scene.h"

namespace stroma {
namespace {
namespace fs = std::filesystem;

class Refusal : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("stroma-abi-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void writeManifest(const std::string& plugin, int abi, std::string_view buildId) const {
    JsonWriter json;
    json.beginObject();
    json.member("name", plugin).member("version", "1.0.0").member("license", "Apache-2.0");
    json.member("summary", "").member("abi", abi).member("buildId", buildId);
    json.member("library", std::string(FIXTURES "/") + plugin + ".so");
    json.key("components").beginArray().value("Wanted").endArray();
    json.endObject();
    std::ofstream(folder_ / (plugin + ".plugin.json")) << json.text();
  }

  // What a scene that names the plugin's component is answered.
  [[nodiscard]] std::string answer() const {
    SceneOptions options;
    options.pluginFolders = {folder_};
    Scene scene(options);
    EXPECT_FALSE(scene.loadText("<Node>\n  <Wanted/>\n</Node>", "scene.xml"));
    return scene.diagnostics().text();
  }

  [[nodiscard]] static std::string expected(const std::string& reason) {
    return "scene.xml:2:4: error: cannot create 'Wanted': " + reason +
           "  [plugin-refused]\n"
           "    2 |   <Wanted/>\n"
           "      |    ^~~~~~\n"
           "1 error, 0 warnings; nothing was started.\n";
  }

  const std::string core_{coreBuildId()};
  const std::string otherVersion_ = "plugin 'newer' was built for interface version " +
                                    std::to_string(coreAbi + 1) + ", this core has version " +
                                    std::to_string(coreAbi) + ": rebuild the plugin";
  const std::string otherBuild_ = "plugin 'foreign' was built as 'msvc-19/double', this core as '" +
                                  core_ +
                                  "': rebuild the plugin with the same compiler and options";
  fs::path folder_;
};

TEST_F(Refusal, anotherInterfaceVersionIsSeenInTheManifest) {
  writeManifest("newer", coreAbi + 1, core_);
  EXPECT_EQ(answer(), expected(otherVersion_));
}

TEST_F(Refusal, anotherInterfaceVersionIsSeenInTheLibrary) {
  writeManifest("newer", coreAbi, core_);
  EXPECT_EQ(answer(), expected(otherVersion_));
}

TEST_F(Refusal, anotherBuildIsSeenInTheManifest) {
  writeManifest("foreign", coreAbi, "msvc-19/double");
  EXPECT_EQ(answer(), expected(otherBuild_));
}

TEST_F(Refusal, anotherBuildIsSeenInTheLibrary) {
  writeManifest("foreign", coreAbi, core_);
  EXPECT_EQ(answer(), expected(otherBuild_));
}

TEST_F(Refusal, aPluginThatFailsToRegisterIsNamed) {
  writeManifest("throwing", coreAbi, core_);
  EXPECT_EQ(answer(), expected("plugin 'throwing' failed to register its components: throwing was "
                               "opened after all"));
}

TEST_F(Refusal, aLibraryThatIsNotThereIsNamed) {
  writeManifest("absent", coreAbi, core_);
  EXPECT_NE(answer().find("cannot load '" FIXTURES "/absent.so'"), std::string::npos) << answer();
}

}  // namespace
}  // namespace stroma
