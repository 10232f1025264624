#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace reprise::cli {

struct VerifyOptions {
    std::string trace;
    std::string expect;  ///< the chain that the user wrote down, 32 hexadecimal digits; or empty
};

struct InfoOptions {
    std::string trace;
    bool long_form = false;
    bool json = false;
};

struct DiffOptions {
    std::string expected;
    std::string found;
    std::optional<double> tolerance;
    std::string actor;  ///< name or id; empty: all
    bool json = false;
    bool all = false;  ///< every differing field of the first differing tick
};

struct RecoverOptions {
    std::string damaged;
    std::string output;
};

struct StripOptions {
    std::string trace;
    std::string output;
    std::string level;
};

struct ExpandOptions {
    std::string trace;
    std::string output;
};

/// Each adds the command of its name.
void add_verify(CLI::App& app, VerifyOptions& verify);
void add_info(CLI::App& app, InfoOptions& info);
void add_diff(CLI::App& app, DiffOptions& diff);
void add_recover(CLI::App& app, RecoverOptions& recover);
void add_strip(CLI::App& app, StripOptions& strip);
void add_expand(CLI::App& app, ExpandOptions& expand);

/// Adds --level, which takes one of these words.
CLI::Option& add_level(CLI::App& command,
                       std::string& level,
                       const std::vector<std::string>& words);

}  // namespace reprise::cli
