#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>

namespace reprise::process {

/// A temporary file without a name: what a child writes there needs no reader meanwhile, and
/// nothing of it is ever left behind.
class NamelessFile {
  public:
    /// Throws world::Error when there is no room for one.
    NamelessFile();

    int descriptor() const;

    /// Whether all of it could be written.
    bool write(const std::string& text) const;

    /// Its first bytes.
    std::string read(std::size_t most) const;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace reprise::process
