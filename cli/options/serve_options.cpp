#include "cli/options/serve_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"

namespace reprise::cli {

void add_serve(CLI::App& app, ServeOptions& serve) {
    CLI::App& command = *app.add_subcommand(
        "serve", "Let other programs begin episodes and drive in them, step by step");
    CLI::Option* const socket =
        command
            .add_option("--socket",
                        serve.socket,
                        "A socket that only you can open (default: reprise.sock in this folder); "
                        "fd:N is an open one, of one client")
            ->type_name("PATH|fd:N");
    CLI::Option* const port =
        command
            .add_option("--port",
                        serve.port,
                        "A TCP port in place of a socket, for programs of yours on this machine; 0 "
                        "takes one that is free")
            ->type_name("N")
            ->excludes(socket);
    CLI::Option* const token =
        command
            .add_option(
                "--token-file", serve.token_file, "A file whose first line a client has to say")
            ->type_name("FILE");
    command
        .add_option("--listen",
                    serve.listen,
                    "Another address than 127.0.0.1, for other machines: in clear text")
        ->type_name("ADDRESS")
        ->needs(port)
        ->needs(token);
    command
        .add_option("--folder",
                    serve.folder,
                    "Where scenarios and towns of clients are, and their traces go; they reach "
                    "nothing outside of it (default: this one)")
        ->type_name("DIR")
        ->check(CLI::ExistingDirectory);
    command.add_option("--episodes", serve.episodes, "At most so many clients at once")
        ->type_name("MOST")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command.add_option("--town", serve.town, "Read this town now, not when the first client asks")
        ->type_name("NAME");
    command.add_option("--memory", serve.memory_gb, "What an episode may use at most, in GB")
        ->type_name("GB")
        ->check(a_number_in(0.5, 1024))
        ->capture_default_str();
    command.footer(
        "Ends with Ctrl-C or SIGTERM; episodes that run end with it, their traces are whole.\n"
        "Python starts one for itself: reprise.Simulation('town1'). See docs/drivers.md");
}

}  // namespace reprise::cli
