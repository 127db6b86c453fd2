// SPDX-License-Identifier: Apache-2.0
#include "core/snapshot.h"

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "core/plugin.h"

namespace stroma {
namespace {

constexpr char fileMagic[8] = {'S', 'T', 'R', 'O', 'M', 'A', 'C', '1'};

void put(std::string& out, const void* data, std::size_t size) {
  out.append(static_cast<const char*>(data), size);
}

template <class T>
void putValue(std::string& out, T value) {
  put(out, &value, sizeof value);
}

void putText(std::string& out, std::string_view text) {
  putValue<std::uint64_t>(out, text.size());
  out += text;
}

// Reads values from the file's bytes; every read is checked against what is left.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  bool take(void* to, std::size_t size) {
    if (size > rest_.size()) return false;
    std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }
  bool takeText(std::string& to) {
    std::uint64_t size = 0;
    if (!take(&size, sizeof size) || size > rest_.size()) return false;
    to.assign(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return true;
  }
  [[nodiscard]] bool empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

}  // namespace

std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (const std::byte b : bytes) {
    hash ^= static_cast<std::uint64_t>(b);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

std::string writeCheckpoint(const std::string& file, const Snapshot& snapshot,
                            std::uint64_t sceneHash) {
  std::string out;
  put(out, fileMagic, sizeof fileMagic);
  putText(out, coreBuildId());
  putValue(out, sceneHash);
  putValue(out, snapshot.step);
  putValue(out, snapshot.time);
  putValue<std::uint64_t>(out, snapshot.chunks.size());
  for (const auto& [name, bytes] : snapshot.chunks) {
    putText(out, name);
    putText(out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  putValue(out, hashBytes(std::as_bytes(std::span(out))));

  // first beside, then in place: a run that dies while writing keeps the older checkpoint
  const std::string beside = file + ".part";
  std::ofstream stream(beside, std::ios::binary);
  stream.write(out.data(), static_cast<std::streamsize>(out.size()));
  stream.close();
  if (!stream) return "cannot write '" + beside + "': " + std::strerror(errno);
  std::error_code failure;
  std::filesystem::rename(beside, file, failure);
  return failure ? "cannot write '" + file + "': " + failure.message() : "";
}

std::string readCheckpoint(const std::string& file, Snapshot& snapshot, std::uint64_t sceneHash) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return "cannot read '" + file + "': " + std::strerror(errno);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::string broken = "'" + file + "' is not a checkpoint or is damaged";
  if (bytes.size() < sizeof fileMagic + sizeof(std::uint64_t) ||
      std::memcmp(bytes.data(), fileMagic, sizeof fileMagic) != 0) {
    return broken;
  }
  const std::string_view body(bytes.data(), bytes.size() - sizeof(std::uint64_t));
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + body.size(), sizeof sum);
  if (sum != hashBytes(std::as_bytes(std::span(body)))) return broken;

  Cursor cursor(body.substr(sizeof fileMagic));
  std::string buildId;
  std::uint64_t scene = 0, chunks = 0;
  Snapshot read;
  if (!cursor.takeText(buildId) || !cursor.take(&scene, sizeof scene)) return broken;
  if (buildId != coreBuildId()) {
    return "'" + file + "' was written by another build (" + buildId +
           "): it cannot be resumed exactly";
  }
  if (scene != sceneHash) {
    return "'" + file + "' belongs to another scene or to other --set values";
  }
  if (!cursor.take(&read.step, sizeof read.step) || !cursor.take(&read.time, sizeof read.time) ||
      !cursor.take(&chunks, sizeof chunks)) {
    return broken;
  }
  for (std::uint64_t i = 0; i < chunks; ++i) {
    std::string name, data;
    if (!cursor.takeText(name) || !cursor.takeText(data)) return broken;
    const auto view = std::as_bytes(std::span(data));
    read.chunks[name].assign(view.begin(), view.end());
  }
  if (!cursor.empty()) return broken;
  snapshot = std::move(read);
  return "";
}

}  // namespace stroma
