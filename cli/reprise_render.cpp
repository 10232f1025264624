// `reprise render`: the program with Embree and OpenCV in it. It has no kernel: what it draws can
// only come from the trace.
#include "cli/process/command_main.h"
#include "cli/render.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [](const CommandLine& line) { return render(line.render); });
}
