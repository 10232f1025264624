// A driver for tests that keeps what it sees: looking_driver FOLDER [kill|kill_run|leave|memory].
// Each frame becomes FOLDER/SENSOR_TICK.raw. In its fourth tick `kill` ends the process that
// renders, `kill_run` writes that one's id to FOLDER/renderer and ends the run, `memory` writes
// what that one's malloc was told to FOLDER/memory; `leave` never says that it is ready.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <unistd.h>

#include "remote/client.h"
#include "world/check.h"

namespace {

namespace fs = std::filesystem;

void keep(const fs::path& folder, const std::string& name, std::span<const std::uint8_t> pixels) {
    std::ofstream(folder / (name + ".raw"), std::ios::binary)
        .write(reinterpret_cast<const char*>(pixels.data()),
               static_cast<std::streamsize>(pixels.size()));
}

/// A child of the run that started us.
pid_t renderer() {
    const std::string run = "/proc/" + std::to_string(getppid());
    std::ifstream children(run + "/task/" + std::to_string(getppid()) + "/children");
    for (pid_t child = 0; children >> child;) {
        std::string name;
        std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
        if (name == "reprise-render")
            return child;
    }
    return 0;
}

/// GLIBC_TUNABLES of a process. glibc ends each setting where it stands when it has read it.
std::string memory_of(pid_t process) {
    std::ifstream environment("/proc/" + std::to_string(process) + "/environ");
    const std::string name = "GLIBC_TUNABLES=";
    std::string told;
    for (std::string each; std::getline(environment, each, '\0');)
        if (each.compare(0, name.size(), name) == 0)
            told = each.substr(name.size());
        else if (!told.empty() && each.compare(0, 6, "glibc.") == 0)
            told += ":" + each;
    return told;
}

void misbehave(const std::string& habit, const fs::path& folder) {
    const pid_t found = renderer();
    if (found == 0)
        std::abort();
    if (habit == "kill")
        kill(found, SIGKILL);
    if (habit == "memory")
        std::ofstream(folder / "memory") << memory_of(found);
    if (habit == "kill_run") {
        std::ofstream(folder / "renderer") << found;
        kill(getppid(), SIGKILL);
    }
}

}  // namespace

int main(int count, char** words) {
    if (count > 2 && std::string(words[2]) == "leave")
        return 5;
    try {
        reprise::remote::Client run;
        int ticks = 0;
        while (const auto tick = run.next()) {
            for (const reprise::world::SensorSpec& sensor : run.sensors()) {
                const std::string name = sensor.name + "_" + std::to_string(tick->index());
                if (!reprise::world::is_camera(sensor.kind)) {
                    if (const auto rows = run.rows(sensor.name))
                        keep(words[1], name, rows->bytes);
                } else if (const auto picture = run.picture(sensor.name)) {
                    keep(words[1], name, picture->pixels);
                }
            }
            if (++ticks == 4 && count > 2)
                misbehave(words[2], words[1]);
            run.say({.throttle = 0.5, .steer = 0.125});
        }
    } catch (const reprise::world::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 6;
    }
    return 0;
}
