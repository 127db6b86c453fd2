// SPDX-License-Identifier: Apache-2.0
// Every scene of this folder is loaded and initialised, and what it is answered is compared with
// the text beside it. STROMA_WRITE_EXPECTED=1 writes the texts anew: read them before you keep
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "core/scene.h"

namespace stroma {
namespace {
namespace fs = std::filesystem;

SceneOptions options() {
  SceneOptions options;
  options.pluginFolders.emplace_back("plugins");
  options.writesOutput = false;
  return options;
}

std::string answer(Scene& scene, bool loaded) {
  if (loaded && scene.initialise()) return "valid\n" + scene.diagnostics().text();
  return scene.diagnostics().text();
}

std::string answerToFile(const fs::path& file) {
  Scene scene(options());
  return answer(scene, scene.load(file));
}

std::string answerToText(std::string text) {
  Scene scene(options());
  return answer(scene, scene.loadText(std::move(text), "generated.xml"));
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(".")) {
    if (entry.path().extension() == ".xml") files.push_back(entry.path().filename());
  }
  std::ranges::sort(files);
  return files;
}

class BrokenScene : public testing::TestWithParam<fs::path> {};

TEST_P(BrokenScene, isAnsweredWithTheExpectedText) {
  const std::string text = answerToFile(GetParam());
  const fs::path expectedFile = fs::path(GetParam()).replace_extension(".txt");
  if (std::getenv("STROMA_WRITE_EXPECTED")) {
    std::ofstream(expectedFile, std::ios::binary) << text;
    return;
  }
  std::ifstream stream(expectedFile, std::ios::binary);
  ASSERT_TRUE(stream) << "there is no " << expectedFile << "; the answer was\n" << text;
  const std::string expected{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, expected);
}

INSTANTIATE_TEST_SUITE_P(Folder, BrokenScene, testing::ValuesIn(scenes()),
                         [](const auto& instance) {
                           std::string name = instance.param.stem().string();
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

// The texts of scenes that are too large to keep.

TEST(HugeScene, aBadNumberAtTheEndOf100MegabytesIsFound) {
  const std::string firstLine = "<Node>\n";
  std::string text = firstLine + "<MechanicalObject name=\"m\" position=\"";
  while (text.size() < 100'000'000) text += "1 2 3 ";
  text += "1 2 x";
  const std::size_t column = text.size() - firstLine.size();
  const std::string answer = answerToText(text + "\"/>\n</Node>");
  EXPECT_LT(answer.size(), 2000u);
  const std::string expected = "generated.xml:2:" + std::to_string(column) +
                               ": error: MechanicalObject 'm': 'position': unknown unit 'x'";
  EXPECT_TRUE(answer.starts_with(expected)) << answer;
}

TEST(HugeScene, a100MegabyteNameIsShortenedInTheMessage) {
  const std::string answer = answerToText("<Node><" + std::string(100'000'000, 'q') + "/></Node>");
  EXPECT_LT(answer.size(), 2000u);
  EXPECT_NE(answer.find("unknown component"), std::string::npos) << answer;
}

TEST(HugeScene, aMillionNodesDeepIsAnErrorNotACrash) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "<Node>\n";
  const std::string answer = answerToText(std::move(text));
  EXPECT_LT(answer.size(), 2000u);
  EXPECT_NE(answer.find("nested too deeply"), std::string::npos) << answer;
}

TEST(HugeScene, manyProblemsAreCountedNotAllPrinted) {
  std::string text = "<Node>\n";
  for (int i = 0; i < 5000; ++i) text += "<MechanicalObject positoin=\"1 2 3\"/>\n";
  const std::string answer = answerToText(text + "</Node>");
  EXPECT_LT(answer.size(), 200'000u);
  EXPECT_NE(answer.find("5000 errors"), std::string::npos) << answer.substr(answer.size() - 200);
}

}  // namespace
}  // namespace stroma
