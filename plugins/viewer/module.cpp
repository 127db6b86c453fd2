// SPDX-License-Identifier: Apache-2.0
#include "core/plugin.h"
#include "plugins/viewer/browser_viewer.h"
#include "plugins/viewer/mouse_device.h"

PLUGIN(viewer, "0.1.0", "Apache-2.0", "Shows a running scene in browser windows.")
(stroma::Registry& registry) {
  registry.add<stroma::BrowserViewer>("BrowserViewer")
      .doc(
          "Serves the page in which a running scene is seen, touched and changed. `stroma view` "
          "holds one beside the scene; a scene itself needs none.")
      .domain("This machine, or a trusted network: who has the address with its token may do all.")
      .example("plugins/viewer/viewer.xml");
  registry.add<stroma::MouseDevice>("MouseDevice")
      .doc("A stylus that a person moves with the mouse in a viewer's window.")
      .domain("Its path is followed exactly, its pace up to maxSpeed; no force is felt.")
      .example("scenes/cornea/interactive.xml");
}
