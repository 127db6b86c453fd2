// SPDX-License-Identifier: Apache-2.0
#include "tools/study/machine.h"

#include <sys/utsname.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "core/number_list.h"
#include "core/plugin.h"

namespace stroma::study {
namespace {

// Value of the first line "name : value" or "name=value" of a file.
std::string valueIn(const char* file, const std::string& name, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos || trimmed(std::string_view(line).substr(0, at)) != name) continue;
    std::string value(trimmed(std::string_view(line).substr(at + 1)));
    std::erase(value, '"');
    return value;
  }
  return "";
}

std::string firstLine(const char* file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

}  // namespace

std::string processorName() {
  const std::string name = valueIn("/proc/cpuinfo", "model name", ':');
  return name.empty() ? "unknown processor" : name;
}

Json describeMachine() {
  utsname system{};
  uname(&system);
  std::array<double, 3> load{};
  if (getloadavg(load.data(), 3) != 3) load = {};
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M UTC", &utc);
  return {{"processor", processorName()},
          {"cores", std::thread::hardware_concurrency()},
          {"governor", firstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
          {"system", valueIn("/etc/os-release", "PRETTY_NAME", '=') + ", " + system.sysname + " " +
                         system.release},
          {"compiler", STROMA_COMPILER " " __VERSION__},
          {"build", STROMA_BUILD_TYPE},
          {"version", STROMA_VERSION},
          {"build_id", std::string(coreBuildId())},
          {"date", date.data()},
          {"load", load}};
}

}  // namespace stroma::study
