#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace reprise::cli {

/// How a person looks at a drive, and how fast it may go.
struct WheelOptions {
    std::string view = "auto";  ///< window, terminal or auto
    double pace = 1;            ///< simulated over real time; 0: as fast as it goes
};

/// A drive by a person.
struct DriveOptions {
    std::string output = "drive.mcap";
    std::string town = "town1";
    std::string model = "sedan";
    std::string weather = "clear_noon";
    std::string camera = "rgb";    ///< or semantic, depth
    std::string place = "driver";  ///< of the camera; or chase
    unsigned width = 256;          ///< [px]
    unsigned height = 144;
    unsigned every = 2;       ///< [ticks] a picture: 10 a second
    std::uint32_t cars = 40;  ///< or world::auto_cars
    std::uint32_t walkers = 0;
    std::optional<std::uint64_t> seed;
    double seconds = 3600;  ///< simulated, at most
    bool goal = false;
    WheelOptions wheel;
};

/// Adds `drive`; what --size is given goes into `size`.
void add_drive(CLI::App& app, DriveOptions& drive, std::string& size);

/// Throws CLI::ValidationError.
void finish_drive(const std::string& size, DriveOptions& drive);

/// What the program reprise-wheel is told.
struct WheelWords {
    WheelOptions wheel;
    bool check = false;  ///< only whether there is anything to look at
};

/// Returns an exit code when that is all there was to do: help, or a mistake, which was printed.
std::optional<int> read_wheel(int argc, char** argv, WheelWords& words);

}  // namespace reprise::cli
