// SPDX-License-Identifier: Apache-2.0
// A plugin whose descriptor says that it was built for another core; built once for each
// difference.
#include <stdexcept>

#include "core/plugin.h"

namespace {
void refuse(stroma::Registry&) { throw std::runtime_error(FIXTURE_NAME " was opened after all"); }
}  // namespace

extern "C" [[gnu::visibility("default")]] const stroma::PluginDescriptor stroma_plugin_descriptor;
const stroma::PluginDescriptor stroma_plugin_descriptor = {stroma::pluginMagic,
                                                           sizeof(stroma::PluginDescriptor),
                                                           FIXTURE_ABI,
                                                           FIXTURE_NAME,
                                                           "1.0.0",
                                                           "Apache-2.0",
                                                           "Must be refused.",
                                                           FIXTURE_BUILD_ID,
                                                           refuse};
