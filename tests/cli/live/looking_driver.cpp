// A driver for tests that keeps what it sees: looking_driver FOLDER [kill]. Each frame becomes
// FOLDER/SENSOR_TICK.raw. `kill`: in its fourth tick it ends the process that renders.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
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
void end_renderer() {
    const std::string run = "/proc/" + std::to_string(getppid());
    std::ifstream children(run + "/task/" + std::to_string(getppid()) + "/children");
    for (pid_t child = 0; children >> child;) {
        std::string name;
        std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
        if (name == "reprise-render")
            kill(child, SIGKILL);
    }
}

}  // namespace

int main(int count, char** words) {
    try {
        reprise::remote::Client run;
        int ticks = 0;
        while (const auto tick = run.next()) {
            for (const reprise::world::SensorSpec& sensor : run.sensors())
                if (const auto picture = run.picture(sensor.name))
                    keep(words[1],
                         sensor.name + "_" + std::to_string(tick->index()),
                         picture->pixels);
            if (count > 2 && ++ticks == 4)
                end_renderer();
            run.say({.throttle = 0.5, .steer = 0.125});
        }
    } catch (const reprise::world::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 6;
    }
    return 0;
}
