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

/// Throws world::Error when this is no place for a trace. Only plain files: renaming over a device
/// or a pipe would replace it.
void check_output(const std::filesystem::path& path);

/// A file that grows as PATH.partial and gets its name when it is whole. One process at a time:
/// the partial file is locked.
class OutputFile {
  public:
    /// Throws world::Error when PATH could not be written in the end either.
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(mcap::View bytes);

    std::uint64_t size() const { return size_; }

    const std::filesystem::path& partial() const { return partial_; }

    /// Puts the bytes on disk and gives the file its name.
    void finish();

    /// Gives up: cuts the file to `size` bytes and leaves it as PATH.partial, or removes it.
    void keep(std::uint64_t size) noexcept;
    void remove() noexcept;

  private:
    void open();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path path_;
    std::filesystem::path partial_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace reprise::replay
