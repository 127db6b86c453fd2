// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/interrupt.h"

#include <signal.h>

#include <atomic>

namespace stroma::cli {
namespace {

std::atomic<int> signalReceived{0};

}  // namespace

void listenForInterrupts() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { signalReceived = signal; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruptSignal() { return signalReceived; }

}  // namespace stroma::cli
