// SPDX-License-Identifier: Apache-2.0
// A haptic tick allocates nothing: operator new counts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/components/haptics/touch_scene.h"

namespace {
thread_local bool counting = false;
std::atomic<long> allocations{0};

void* allocate(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  void* memory = nullptr;
  if (posix_memalign(&memory, std::max(alignment, sizeof(void*)), size) != 0)
    throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace stroma {
namespace {

std::atomic<long> readings{0};

// A hand that counts the allocations of the thread that reads it, from the second reading on.
class CountingDevice final : public HapticDevice {
 public:
  [[nodiscard]] ToolSample read(double time) noexcept override {
    counting = readings > 0;  // the first one is made by who starts the thread
    ++readings;
    ToolSample sample;
    sample.time = time;
    // a fault now and then, too
    const bool bad = readings % 50 == 0;
    sample.pose.position = Vec3(0, 0, bad ? 1.0 : 0.01 * std::cos(10 * time));
    sample.sequence = static_cast<std::uint64_t>(readings);
    return sample;
  }
  void write(double, const Vec3&, const Vec3&) noexcept override {}
};

TEST(Allocation, theCounterCounts) {
  const long before = allocations;
  counting = true;
  auto* number = new int(7);
  counting = false;
  delete number;
  EXPECT_EQ(allocations - before, 1);
}

TEST(Allocation, aTickOfTheHapticThreadAllocatesNothing) {
  TouchOptions options;
  options.realTime = true;
  options.device = "<Extra name=\"hand\"/>";
  options.controller = "device=\"@hand\"";
  const long before = allocations;
  readings = 0;
  TouchScene touch = touchScene<CountingDevice>(options);
  ASSERT_TRUE(touch.controller) << touch.problems;
  while (readings < 400) {
    touch.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  touch.scene->stop();
  std::printf("%ld allocations in %ld ticks\n", allocations - before, readings.load());
  EXPECT_EQ(allocations - before, 0);
}

TEST(Allocation, ticksInLockStepAllocateNothing) {
  TouchScene touch = touchScene({});
  ASSERT_TRUE(touch.controller);
  HapticLoop loop;
  SoftwareHandDevice* hand = nullptr;
  for (const auto& c : touch.scene->root().components()) {
    if (auto* found = dynamic_cast<SoftwareHandDevice*>(c.get())) hand = found;
  }
  ASSERT_TRUE(hand);
  loop.connect(*hand, 1000);
  LocalContactModel model;
  model.sequence = 1;
  model.planeCount = maxContactPlanes;
  HapticReport report;
  const long before = allocations;
  counting = true;
  for (int i = 0; i < 2000; ++i) {
    model.time = loop.now();
    loop.publish(model);
    loop.tick();
    static_cast<void>(loop.newest(report));
  }
  counting = false;
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(report.state.force.norm(), 0.1);
}

}  // namespace
}  // namespace stroma
