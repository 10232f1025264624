#pragma once

#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace reprise::test {

/// A command that writes something; the word OUT stands for where to.
struct WritingCommand {
    std::string name;  ///< of the test
    std::vector<std::string> words;
    bool makes_folder = false;
    bool streams = false;  ///< text, which may go into a pipe

    std::vector<std::string> to(const std::string& out) const;
};

/// All there are.
const std::vector<WritingCommand>& writing_commands();

/// What they work on: a drive, its parts, a CARLA log, a map, a scenario with its golden. Made
/// once; `folder` gets a copy.
void give_inputs(const Folder& folder);

}  // namespace reprise::test
