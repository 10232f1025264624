#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "files/output_file.h"

namespace reprise::cli {

/// Text on its way to the standard output (path "-" or empty), to a device or a pipe, or to a file,
/// which gets its name when it is finished. Throws world::Error when it cannot be written.
class Output {
  public:
    explicit Output(const std::string& path);
    ~Output() = default;
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    /// Append here; `flush_if_large` from time to time.
    std::string text;
    void flush_if_large();
    void finish();

  private:
    void flush();
    [[noreturn]] void fail(int error) const;

    std::string path_;
    std::unique_ptr<files::OutputFile> file_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_{nullptr, &std::fclose};
};

/// A reader that closed its end of the pipe (`| head`) has all it wanted: the program ends without
/// a word, as cat does. For programs that only write to the standard output.
void end_quietly_when_nobody_reads();

/// Throws world::Error when both are one file.
void refuse_overwriting(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace reprise::cli
