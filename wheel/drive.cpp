#include "wheel/drive.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wheel/dashboard.h"
#include "wheel/hands.h"
#include "wheel/pace.h"
#include "world/town.h"

namespace reprise::wheel {

const char* const keys_text =
    "arrows or WASD drive, space is the hand brake, R reverse when it stands, Tab another picture, "
    "P pause, Esc ends";

namespace {

constexpr double far_ahead = 100;      // [m] gap_ahead when nobody is there
constexpr double paused_glance = 0.1;  // [s]

/// The sensor that is shown first: colours before classes before depth.
std::size_t first_shown(const world::SensorRig& sensors) {
    constexpr std::array order{
        world::SensorKind::rgb, world::SensorKind::semantic, world::SensorKind::depth};
    for (const world::SensorKind kind : order)
        for (std::size_t i = 0; i < sensors.size(); ++i)
            if (sensors[i].kind == kind)
                return i;
    return 0;
}

class Drive {
  public:
    Drive(remote::Client& run, View& view, const Clock& clock, double pace)
        : run_(run),
          view_(view),
          clock_(clock),
          pace_(pace, run.step()) {
        world::SensorRig cameras = run.sensors();
        std::erase_if(cameras, [](const auto& one) { return !world::is_camera(one.kind); });
        for (const world::SensorSpec& camera : cameras)
            cameras_.push_back(camera.name);
        shown_ = first_shown(cameras);
    }

    /// Answers a tick; false when that was the last one.
    bool answer(const world::TickView& tick) {
        const world::VehicleState* ego = world::find(tick.vehicles(), run_.actor());
        const world::Measurement* own = world::find(tick.measurements(), run_.actor());
        if (ego == nullptr || own == nullptr) {
            run_.say({.brake = 1});
            return true;
        }
        if (!hands_)
            hands_.emplace(world::vehicle_models()[ego->model()]);
        look();
        const double due = pace_.wait(tick.index(), clock_());
        Dashboard told = tell(tick, *own);
        view_.show(image_ ? &*image_ : nullptr, to_line(told));
        const Wishes wishes = hear(due, told);
        if (wishes.end) {
            run_.leave("the person at the wheel ended it");
            return false;
        }
        run_.say(hands_->advance(wishes, own->speed(), run_.step()));
        return true;
    }

  private:
    /// What the rig shows now; the last picture where none is due.
    void look() {
        if (cameras_.empty())
            return;
        if (const auto picture = run_.picture(cameras_[shown_]))
            image_ = image_of(*picture);
    }

    Dashboard tell(const world::TickView& tick, const world::Measurement& own) const {
        Dashboard told;
        told.speed = own.speed();
        told.reverse = hands_->in_reverse();
        if (own.lane() < run_.town().lanes.size())
            told.limit = run_.town().lanes[own.lane()].speed_limit;
        if (own.gap_ahead() < far_ahead)  // nan, too, is none
            told.gap = own.gap_ahead();
        told.way = run_.way();
        told.time = static_cast<double>(tick.index()) * run_.step();
        told.factor = pace_.factor();
        return told;
    }

    /// What is wanted when it is time to answer; through a pause.
    Wishes hear(double due, Dashboard told) {
        Wishes wishes = view_.wait(due);
        next_picture(wishes);
        if (wishes.pause % 2 == 0)
            return wishes;
        told.paused = true;
        view_.show(image_ ? &*image_ : nullptr, to_line(told));
        do {
            wishes = view_.wait(paused_glance);
            next_picture(wishes);
        } while (wishes.pause % 2 == 0 && !wishes.end);
        return wishes;
    }

    void next_picture(const Wishes& wishes) {
        if (!cameras_.empty())
            shown_ = (shown_ + wishes.sensor) % cameras_.size();
    }

    remote::Client& run_;
    View& view_;
    const Clock& clock_;
    Pace pace_;
    std::optional<Hands> hands_;
    std::vector<std::string> cameras_;  ///< of the rig, which may carry other sensors as well
    std::size_t shown_ = 0;             ///< index in them
    std::optional<Image> image_;
};

}  // namespace

void drive(remote::Client& run, View& view, const Clock& clock, double pace) {
    Drive drive(run, view, clock, pace);
    while (const auto tick = run.next())
        if (!drive.answer(*tick))
            return;
}

}  // namespace reprise::wheel
