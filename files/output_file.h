#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "files/ending.h"

namespace reprise::files {

/// What is to become of a file that was not finished.
enum class Unfinished : std::uint8_t {
    keep,   ///< what is in it is worth keeping, as PATH.partial
    remove  ///< nothing of it stays, also when a signal ends us
};

/// A file that grows as PATH.partial and gets its name when it is whole: links are followed, what
/// was there is replaced at once. One process at a time: the partial file is locked.
class OutputFile {
  public:
    /// `what` is to be written, for messages: "the trace". Throws world::Error when PATH could not
    /// be written in the end either: nothing but a plain file is ever replaced.
    explicit OutputFile(const std::filesystem::path& path,
                        std::string what,
                        Unfinished unfinished = Unfinished::remove,
                        const std::string& ending = ".partial");
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(std::span<const std::uint8_t> bytes);
    void append(std::string_view text);

    std::uint64_t size() const { return size_; }

    const std::filesystem::path& partial() const { return partial_; }

    /// Puts the bytes on disk, unless they may be lost when the power is, and gives the file its
    /// name.
    void finish(bool on_disk = true);

    /// Gives up: cuts the file to `size` bytes and leaves it as PATH.partial, or removes it.
    void keep(std::uint64_t size) noexcept;
    void remove() noexcept;

  private:
    void open();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path named_;  ///< as the user did
    std::filesystem::path path_;   ///< behind its links
    std::filesystem::path partial_;
    std::string what_;
    Unfinished unfinished_;
    std::optional<RemovedWhenEnded> note_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// A whole file at once, not waiting for the disk.
void write_file(const std::filesystem::path& path, const std::string& what, std::string_view text);
void write_file(const std::filesystem::path& path,
                const std::string& what,
                std::span<const std::uint8_t> bytes);

}  // namespace reprise::files
