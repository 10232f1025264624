// libFuzzer at both ends of the wire: whatever a driver says, or writes into its mailbox, the run's
// seat answers with a control or says that it is lost; whatever a run says, the driver's client
// sees ticks, an end or an error. Start: wire_fuzz --seeds FOLDER writes inputs; wire_fuzz FOLDER.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

#include "remote/client.h"
#include "remote/frame_channel.h"
#include "remote/mailbox.h"
#include "remote/schema.h"
#include "remote/seat.h"
#include "tests/fuzz/start.h"
#include "tests/support/worlds.h"
#include "world/check.h"

namespace {

using namespace reprise;
using Bytes = std::vector<std::uint8_t>;

// The first byte of an input.
constexpr unsigned to_client = 1;  // else to the seat
constexpr unsigned framed =
    2;  // kind, size (two bytes), body, ...: made frames; else bytes as they are
constexpr unsigned by_mail = 4;  // the same in a driver's mailbox, after it said that it is ready

const world::Recording& recording() {
    static const world::Recording all = [] {
        world::Recording one;
        one.town = test::straight_road(60);
        one.episode = test::episode();
        return one;
    }();
    return all;
}

const world::SealedTick& tick() {
    static const world::SealedTick one =
        test::tick_with({test::vehicle_at(1, 20, -1.75)}, {test::car_at(1'000'001, 40, -1.75)});
    return one;
}

void add_frame(Bytes& to, std::uint32_t kind, std::span<const std::uint8_t> body) {
    const std::array<std::uint32_t, 2> header{static_cast<std::uint32_t>(body.size()), kind};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(header.data());
    to.insert(to.end(), bytes, bytes + sizeof(header));
    to.insert(to.end(), body.begin(), body.end());
}

Bytes said_by(std::span<const std::uint8_t> input, bool frames) {
    if (!frames)
        return {input.begin(), input.end()};
    Bytes all;
    while (input.size() >= 3) {
        const std::size_t size =
            std::min<std::size_t>(input[1] + 256U * input[2], input.size() - 3);
        add_frame(all, input[0] % 8, input.subspan(3, size));
        input = input.subspan(3 + size);
    }
    return all;
}

/// As much of it as the socket takes, and no more to come.
void say(int socket, const Bytes& bytes) {
    if (send(socket, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL) < 0 &&
        errno != EAGAIN)
        std::abort();
    shutdown(socket, SHUT_WR);
}

/// What the other end said is thrown away, or it would wait for us.
void drain(int socket) {
    std::array<char, 4096> some{};
    while (recv(socket, some.data(), some.size(), MSG_DONTWAIT) > 0) {
    }
}

/// What a driver writes into its mailbox: kind and its highest bit for a length that is none, size
/// (two bytes), body, ...
class Mail {
  public:
    explicit Mail(std::span<const std::uint8_t> input)
        : memory_(remote::Mailbox::bytes()),
          input_(input) {}

    /// `to_run`: says ready, and hands it over.
    void hand_over(int to_run) const {
        remote::FrameChannel channel(dup(to_run), 64 << 10);
        flatbuffers::FlatBufferBuilder builder;
        builder.Finish(
            remote::CreateReady(builder, remote::wire_version, 0, remote::Mailbox::bytes()));
        channel.send(remote::Kind::ready,
                     {builder.GetBufferPointer(), builder.GetSize()},
                     {},
                     memory_.descriptor());
    }

    /// The next letter, where the run looks for that number, as remote/mailbox.cpp lays it.
    void lay(std::uint32_t number) {
        if (input_.size() < 3)
            return;
        const std::size_t size = std::min<std::size_t>(
            {input_[1] + 256U * input_[2], input_.size() - 3, remote::Mailbox::to_run});
        const std::uint32_t told = input_[0] < 128 ? static_cast<std::uint32_t>(size) : ~0U;
        const std::array<std::uint32_t, 5> place{number, number, 0, input_[0] % 128U, told};
        const auto memory = memory_.writable();
        std::memcpy(&memory[64], place.data(), sizeof(place));
        const auto body = input_.subspan(3, size);
        std::copy(body.begin(), body.end(), memory.last(remote::Mailbox::to_run).begin());
        input_ = input_.subspan(3 + size);
    }

  private:
    remote::SharedMemory memory_;
    std::span<const std::uint8_t> input_;
};

/// Five ticks with a driver that says this, by mail or through the socket.
void drive_seat(const Bytes& said, Mail* mail = nullptr) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0)
        std::abort();
    constexpr std::size_t largest_answer = 64 << 10;  // [bytes] as a run takes them
    remote::Seat seat("ego", remote::FrameChannel(ends[1], largest_answer), {5.0});
    const int socket_to_run = ends[0];
    if (mail != nullptr)
        mail->hand_over(socket_to_run);
    say(socket_to_run, said);
    bool lost = seat.take(1, recording()).has_value();
    for (std::uint32_t i = 0; i < 5 && !lost; ++i) {
        lost = seat.show(tick()).has_value();
        if (lost)
            break;
        if (mail != nullptr)
            mail->lay(i + 1);
        const auto answer = seat.answer();
        lost = std::holds_alternative<remote::Lost>(answer);
        if (const auto* control = std::get_if<world::Control>(&answer))
            REPRISE_CHECK(control->throttle() >= 0 && control->throttle() <= 1 &&
                              control->brake() >= 0 && control->brake() <= 1 &&
                              control->steer() >= -1 && control->steer() <= 1,
                          "a control that no car can do");
        drain(socket_to_run);
    }
    close(socket_to_run);
}

/// A driver in a run that says this.
void drive_client(const Bytes& said) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0)
        std::abort();
    setenv("REPRISE_DRIVER", ("fd:" + std::to_string(ends[0])).c_str(), 1);
    say(ends[1], said);
    try {
        remote::Client run;
        while (run.next()) {
            run.say({.throttle = 0.5});
            drain(ends[1]);
        }
    } catch (const world::Error&) {
        // Told.
    }
    close(ends[1]);
}

// --- Inputs to start from: what well-behaved ends say.

template <class Fill>
void add_message(std::string& to, remote::Kind kind, Fill fill) {
    flatbuffers::FlatBufferBuilder builder;
    fill(builder);
    to += static_cast<char>(kind);
    to += static_cast<char>(builder.GetSize() % 256);
    to += static_cast<char>(builder.GetSize() / 256);
    to.append(reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize());
}

flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>> bytes_in(
    flatbuffers::FlatBufferBuilder& builder, std::span<const std::uint8_t> bytes) {
    builder.ForceVectorAlignment(bytes.size(), 1, 16);
    return builder.CreateVector(bytes.data(), bytes.size());
}

template <class Table, class Object>
Bytes packed(const Object& object) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(Table::Pack(builder, &object));
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

std::string of_driver() {
    std::string text(1, static_cast<char>(framed));
    add_message(text, remote::Kind::ready, [](auto& builder) {
        builder.Finish(remote::CreateReady(
            builder, remote::wire_version, builder.CreateString(remote::schema_digest())));
    });
    for (int i = 0; i < 2; ++i)
        add_message(text, remote::Kind::control, [](auto& builder) {
            builder.Finish(remote::CreateControl(builder, 1, 0.5, 0.25, -0.5, true, false, 8));
        });
    add_message(text, remote::Kind::goodbye, [](auto& builder) {
        builder.Finish(remote::CreateGoodbye(builder, builder.CreateString("no more")));
    });
    return text;
}

std::string by_mail_of_driver() {
    std::string text(1, static_cast<char>(by_mail));
    for (int i = 0; i < 3; ++i)
        add_message(text, remote::Kind::control, [](auto& builder) {
            builder.Finish(remote::CreateControl(builder, 1, 0.5, 0.25, -0.5, true, false, 8));
        });
    return text;
}

std::string of_run() {
    std::string text(1, static_cast<char>(framed | to_client));
    add_message(text, remote::Kind::hello, [](auto& builder) {
        const auto schema = builder.CreateString(remote::schema_digest());
        const auto name = builder.CreateString("ego");
        const auto episode = bytes_in(builder, packed<world::Episode>(recording().episode));
        const auto town = bytes_in(builder, packed<world::Town>(recording().town));
        builder.Finish(remote::CreateHello(
            builder, remote::wire_version, schema, 1, name, 50'000'000, episode, town));
    });
    for (int i = 0; i < 2; ++i)
        add_message(text, remote::Kind::observation, [](auto& builder) {
            const auto traffic = bytes_in(builder, tick().traffic_bytes());
            const auto of_tick = bytes_in(builder, tick().tick_bytes());
            builder.Finish(remote::CreateObservation(builder, of_tick, traffic));
        });
    return text;
}

/// The same as bytes that need no frames to be made.
std::string plain(const std::string& text) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    const Bytes said = said_by({bytes + 1, text.size() - 1}, true);
    return static_cast<char>(bytes[0] & to_client) + std::string(said.begin(), said.end());
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    return test::start_fuzzing(argc, argv, [](const std::filesystem::path& folder) {
        test::write_seed(folder / "driver", of_driver());
        test::write_seed(folder / "driver_plain", plain(of_driver()));
        test::write_seed(folder / "driver_mail", by_mail_of_driver());
        test::write_seed(folder / "run", of_run());
        test::write_seed(folder / "run_plain", plain(of_run()));
    });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0)
        return 0;
    const std::span<const std::uint8_t> input(data + 1, size - 1);
    const Bytes said = said_by(input, (data[0] & framed) != 0);
    if ((data[0] & by_mail) != 0) {
        Mail mail(input);
        drive_seat({}, &mail);
    } else if ((data[0] & to_client) != 0)
        drive_client(said);
    else
        drive_seat(said);
    return 0;
}
