#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/options/serve_options.h"
#include "kernel/physics/solid_ground.h"
#include "process/held_signals.h"
#include "remote/frame_channel.h"
#include "world/recording.h"

namespace reprise::cli {

/// A town that is ready for episodes: what all that are played there share.
struct ReadyTown {
    std::string name;            ///< as it was asked for
    world::Recording recording;  ///< but for the episode
    std::unique_ptr<const kernel::SolidGround> ground;
};

/// Reads a town by its name. Throws world::Error.
std::unique_ptr<ReadyTown> make_ready(const std::string& town, const std::string& folder);

/// One client, from its first word until it leaves: begins the episodes that it asks for. Lives in
/// a process of its own.
class Session {
  public:
    /// `token`: what the client has to say first; empty: nothing. `town` may be null. The signals
    /// must outlive it.
    Session(const ServeOptions& options,
            std::string token,
            std::unique_ptr<ReadyTown> town,
            remote::FrameChannel client,
            const process::HeldSignals& signals);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Until the client leaves, or a signal asks us to end. `greeting`: [s] of real time for its
    /// first word; without, for ever, as for a client that started us and may be stopped itself.
    /// `why_not`: asked when that word is right, why it may not stay all the same; empty: it may.
    /// Throws nothing.
    void run(std::optional<double> greeting, const std::function<std::string()>& why_not);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::cli
