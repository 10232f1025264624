// `reprise render`: the program with Embree and OpenCV in it. It has no kernel: what it draws can
// only come from the trace.
#include "cli/options/options.h"
#include "cli/process/guard.h"
#include "cli/render.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return guarded(command_text(argc, argv), [&] {
        CommandLine line;
        if (const auto code = line.parse(argc, argv))
            return *code;
        return render(line.render);
    });
}
