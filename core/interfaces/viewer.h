// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/component.h"

namespace stroma {

class Diagnostics;

// What the session that makes the steps is doing.
struct SessionState {
  bool playing = false;
  double speed = 1;           // simulated seconds a second of wall clock that are asked for
  double realTimeFactor = 0;  // and reached, while playing
  double stepTime = 0;        // s of wall clock, the mean over the last steps
  std::vector<double> kept;   // times (s) of the kept states, rising: one can go back to them
  std::string stopped;        // why it cannot go on (a divergence), empty when it can
};

// What a person asks of the session.
struct ViewerRequest {
  enum class Kind {
    play,
    pause,
    step,     // number: so many steps, then pause
    reset,    // back to the start
    rewind,   // number: to the kept state nearest to this time (s)
    speed,    // number: as SessionState::speed
    set,      // path of an attribute, text: its new value
    replace,  // path of a component, text: its new type, or its new element ("<ScalpelTool .../>")
    insert,   // path of a node, text: elements that are put at its end
    undo,     // the last set, replace or insert
    reload,   // reads the file again; changes made by requests stay
    revert,   // reads the file again without the changes
    sceneText,  // answered with the scene as XML, the changes included
    picture,    // a picture was made: text is the PNG file; or it could not be: path says why
  };
  Kind kind = Kind::play;
  std::string path{}, text{};
  double number = 0;
  std::uint64_t ticket = 0;  // what answer() gives back
};

// Shows a running scene to a person and hands on what the person does. Whoever makes the steps (the
// session) holds a viewer in a scene of its own, beside the scenes that it shows one after another.
// All calls are made between steps, by the thread that makes them; none waits for anybody who
// watches. Connections are opened in start().
class Viewer : public Component {
 public:
  static constexpr std::string_view role = "Viewer";

  // Where it is to be seen: what the session prints.
  [[nodiscard]] virtual std::string address() const = 0;
  // Shows this scene from now on. The one before is not looked at any more; the new one stays valid
  // until the next call. `changes` says in what it differs from its file, a line each.
  virtual void show(Scene& scene, const std::vector<std::string>& changes) = 0;
  // The state may have changed. Says what is new to those who watch, if it is time for it.
  virtual void publish(const SessionState& session) = 0;
  // Problems of a scene that could not be taken; the one that is shown goes on. Without problems:
  // those reported before are mended.
  virtual void report(const Diagnostics& diagnostics) = 0;
  // What was asked for since the last call, in this order.
  [[nodiscard]] virtual std::vector<ViewerRequest> takeRequests() = 0;
  // A request was done, or could not be: `text` is then why, else what was asked for, if anything.
  virtual void answer(std::uint64_t ticket, bool done, const std::string& text) = 0;
};

}  // namespace stroma
