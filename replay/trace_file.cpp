#include "replay/trace_file.h"

namespace reprise::replay {

TraceFile::TraceFile(const std::filesystem::path& path, Level level, files::Unfinished unfinished)
    : TraceFile(path, trace_channels(level), unfinished) {}

TraceFile::TraceFile(const std::filesystem::path& path,
                     const std::vector<Channel>& channels,
                     files::Unfinished unfinished,
                     const std::string& what)
    : sink_(path, what, unfinished) {
    try {
        records_ = std::make_unique<TraceRecords>(sink_, channels);
    } catch (...) {
        abandon();
        throw;
    }
}

void TraceFile::finish() {
    records_->finish();
    sink_.file.finish();
}

void TraceFile::abandon() noexcept {
    if (has_chunks())
        sink_.file.keep(records_->whole());
    else
        sink_.file.remove();
}

}  // namespace reprise::replay
