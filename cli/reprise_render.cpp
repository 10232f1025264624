// `reprise render`: the program with Embree and OpenCV in it. It has no kernel: what it draws can
// only come from the trace, or from a run that started it to look on.
#include <string_view>

#include "cli/dataset/dataset.h"
#include "cli/live.h"
#include "cli/pictures/folder_comparison.h"
#include "cli/process/command_main.h"
#include "cli/process/guard.h"
#include "cli/render.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    if (argc == 2 && std::string_view(argv[1]) == "live")
        return guarded(command_text(argc, argv), live);
    return command_main(argc, argv, [](const CommandLine& line) {
        if (line.command == "diff")
            return compare_folders(line.diff.expected, line.diff.found);
        return line.command == "dataset" ? dataset(line.dataset) : render(line.render);
    });
}
