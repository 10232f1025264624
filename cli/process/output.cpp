#include "cli/process/output.h"

#include <csignal>
#include <cstdio>

#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr std::size_t large = 1 << 18;

}  // namespace

Output::Output(const std::string& path) {
    if (!path.empty() && path != "-")
        file_ = std::make_unique<replay::OutputFile>(path);
}

Output::~Output() {
    if (file_ && !finished_)
        file_->remove();
}

void Output::flush_if_large() {
    if (text.size() >= large)
        flush();
}

void Output::flush() {
    if (file_)
        file_->append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
        throw world::Error("cannot write to the standard output");
    text.clear();
}

void Output::finish() {
    flush();
    if (file_)
        file_->finish();
    finished_ = true;
}

void end_quietly_when_nobody_reads() {
    // Whoever started us may have switched the signal off, as Python does.
    std::signal(SIGPIPE, SIG_DFL);
}

void refuse_overwriting(const std::filesystem::path& input, const std::filesystem::path& output) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, output, ignored))
        throw world::Error(output.string() +
                           ": the output is the input; give it another name with -o");
}

}  // namespace reprise::cli
