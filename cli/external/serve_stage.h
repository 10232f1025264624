#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "kernel/physics/solid_ground.h"
#include "process/held_signals.h"
#include "process/limits.h"
#include "process/offshoot.h"
#include "remote/frame_channel.h"
#include "world/recording.h"

namespace reprise::cli {

/// Where the episodes of one recording's start are played: a process that has the kernel ready
/// before its first step, and makes a copy of itself for each episode. So equal episodes begin in
/// the time of a fork, and none finds anything that an earlier one has left.
class Stage {
  public:
    /// What it starts from; all must outlive the stage.
    struct Set {
        const world::Recording& recording;
        const kernel::SolidGround& ground;
        const remote::FrameChannel& client;
        const process::HeldSignals& signals;
        std::filesystem::path folder;  ///< where traces go
        process::Limits limits;        ///< of an episode
    };

    /// How an episode ended, as far as the session has something to do about it.
    struct End {
        std::optional<remote::Frame> next{};  ///< what the client said in place of a control
        bool stopped = false;                 ///< a signal ended us
        bool left = false;                    ///< the client said goodbye
    };

    explicit Stage(const Set& set);

    /// Plays one episode to its end; `reset` is checked already. Throws world::Error when there was
    /// none, because the kernel could not be made, or when it crashed: the client was told nothing
    /// then, and the stage is of no use any more.
    End play(const remote::Frame& reset);

  private:
    Stage(const Set& set, const std::array<int, 2>& ends);
    remote::Frame wait_for_word(bool& asked_to_end);

    Set set_;
    remote::FrameChannel line_;  ///< to the process; made before it
    process::Offshoot host_;
};

}  // namespace reprise::cli
