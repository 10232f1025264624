#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// A file to read. pread rather than a mapping: a mapped file that shrinks ends the process.
class InputFile {
  public:
    /// `kind` is what it should be, for messages.
    explicit InputFile(std::filesystem::path path, std::string kind = "trace");
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::uint64_t size() const { return size_; }

    /// Fills `out` from this offset on. The range must lie in the file.
    void read(std::uint64_t offset, std::span<std::uint8_t> out) const;
    mcap::Bytes read(std::uint64_t offset, std::uint64_t size) const;

    /// Throws world::Error: "run.mcap: byte 1234: <what>".
    [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const;

  private:
    std::filesystem::path path_;
    std::string kind_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace reprise::replay
