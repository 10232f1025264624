#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernel/drill/nudge.h"
#include "kernel/physics/solid_ground.h"
#include "kernel/stage.h"
#include "walkers/on_foot.h"
#include "world/check_result.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::kernel {

/// The simulation: turns one sealed tick and the drivers' controls into the next sealed tick.
/// One at a time in a process, because libsumo is one a process.
class Kernel {
  public:
    /// Starts everything; the world is empty until the first step. `recording` must outlive this.
    /// `ground`: the town's, where it has been made already; must outlive this, too.
    explicit Kernel(const world::Recording& recording, const SolidGround* ground = nullptr);
    ~Kernel();
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    /// One fixed step; not after finished(). `controls` are for vehicles with driver `manual`;
    /// those that get none keep their last. Once the scenario has given a vehicle a control, it
    /// drives it, and what comes from outside for it is left alone: so verify, which hands over
    /// what was recorded, finds out whether the scenario says the same again. The result lives
    /// until the next step. Throws world::Error for what the scenario asks in vain; the kernel is
    /// of no use afterwards.
    const world::SealedTick& step(std::span<const world::Control> controls = {});

    /// The part of the next step that looks at no control: most of it, where there is traffic. For
    /// the time in which drivers in other programs think; step() does it where nobody did. It
    /// changes nothing that can be asked here, and what it throws is thrown by step().
    void begin_step();

    /// True once the scenario said finish or the episode's last tick was made.
    bool finished() const;

    world::Outcome outcome() const;

    std::vector<world::CheckResult> checks() const;

    /// From here on another script says what happens, or the same with other parameters: traffic,
    /// walkers, contacts and random streams go on from where they are. What the recording itself
    /// names is done without being asked. Throws world::Error, "brake.lua:3: ...", for a script
    /// that does not compile.
    void branch(const world::BranchT& branch);

    /// Keeps no thread until the next step: so that the process can be copied (process/copy.h).
    void rest();

    /// A drill, to be asked for before its tick. Not part of the recording.
    void nudge(const Nudge& nudge);

  private:
    void begin();
    walkers::OnFoot drive_and_walk(const world::TickView& last, world::TickDraft& next);
    void look_ahead(std::uint64_t tick);
    void take_branch(std::uint64_t tick);
    void note_outcome(world::TickDraft& next);
    void close(Stage stage, world::TickDraft& next);
    void record(world::TickDraft& next);

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::kernel
