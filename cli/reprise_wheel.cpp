// `reprise-wheel`: the driver that is a person. Started by `reprise drive`, or by --driver
// NAME=keyboard; it finds its run as every driver does.
#include <chrono>

#include "cli/options/drive_options.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "wheel/drive.h"

int main(int argc, char** argv) {
    using namespace reprise;
    return cli::guarded(cli::command_text(argc, argv), [&] {
        cli::WheelWords words;
        if (const auto code = cli::read_wheel(argc, argv, words))
            return *code;
        const wheel::Clock clock = [begin = std::chrono::steady_clock::now()] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        if (words.check) {
            wheel::open_view(words.wheel.view, clock);
            return 0;
        }
        remote::Client run;
        if (run.sensors().empty())
            cli::say(stderr,
                     "reprise: '{}' carries no rig: there is no picture of it, only its dashboard "
                     "(spawn{{ ..., rig = {{ {{ name = 'front' }} }} }})\n",
                     run.name());
        cli::say(stderr, "reprise: {}\n", wheel::keys_text);
        const auto view = wheel::open_view(words.wheel.view, clock);
        wheel::drive(run, *view, clock, words.wheel.pace);
        return 0;
    });
}
