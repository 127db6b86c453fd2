// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM: the first one asks the command to end after what it is doing, a second one
// kills, as if nobody listened.
#pragma once

namespace stroma::cli {

void listenForInterrupts();
// The signal that came, 0 for none.
[[nodiscard]] int interruptSignal();

}  // namespace stroma::cli
