#include "render/codecs/exr.h"

#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include "world/check.h"

namespace reprise::render {

namespace {

/// A file in memory, that OpenEXR writes to and goes back in.
class Memory final : public Imf::OStream {
  public:
    Memory() : OStream("memory") {}

    void write(const char* bytes, int size) override {
        const std::size_t end = at_ + static_cast<std::size_t>(size);
        if (end > file.size())
            file.resize(end);
        std::memcpy(file.data() + at_, bytes, static_cast<std::size_t>(size));
        at_ = end;
    }

    std::uint64_t tellp() override { return at_; }

    void seekp(std::uint64_t position) override { at_ = position; }

    std::vector<std::uint8_t> file{};

  private:
    std::size_t at_ = 0;
};

class Bytes final : public Imf::IStream {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : IStream("memory"), bytes_(bytes) {}

    bool read(char* target, int size) override {
        if (at_ > bytes_.size() || static_cast<std::size_t>(size) > bytes_.size() - at_)
            throw std::runtime_error("ends too early");
        std::memcpy(target, bytes_.data() + at_, static_cast<std::size_t>(size));
        at_ += static_cast<std::size_t>(size);
        return at_ < bytes_.size();
    }

    std::uint64_t tellg() override { return at_; }

    void seekg(std::uint64_t position) override { at_ = position; }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

/// Channel `index` of the interleaved ones.
Imf::Slice slice(const Numbers& numbers, std::size_t index) {
    // OpenEXR's one kind of slice reads and writes.
    auto* base = reinterpret_cast<char*>(const_cast<std::uint8_t*>(numbers.data.data()));
    return {Imf::FLOAT,
            base + index * sizeof(float),
            static_cast<std::size_t>(numbers.channels) * sizeof(float),
            numbers.row_bytes()};
}

Numbers read(Imf::InputFile& file) {
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    const Imf::ChannelList& channels = file.header().channels();
    int count = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        ++count;
    if (width <= 0 || height <= 0 || width * height > most_pixels_read || count < 1 || count > 4 ||
        window.min.x != 0 || window.min.y != 0)
        throw std::runtime_error("no picture of ours");
    Numbers numbers{
        static_cast<int>(width), static_cast<int>(height), count, world::PixelType::f32, {}};
    numbers.data.resize(numbers.row_bytes() * static_cast<std::size_t>(height));
    Imf::FrameBuffer buffer;
    std::size_t index = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw std::runtime_error("no picture of ours");
        buffer.insert(channel.name(), slice(numbers, index++));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(0, numbers.height - 1);
    return numbers;
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Numbers& numbers) {
    REPRISE_CHECK(
        numbers.type == world::PixelType::f32 && (numbers.channels == 1 || numbers.channels == 3),
        "a picture of " + std::to_string(numbers.data.size()) + " bytes");
    constexpr std::array colours{"R", "G", "B"};
    Imf::Header header(numbers.width, numbers.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < static_cast<std::size_t>(numbers.channels); ++i) {
        const char* name = numbers.channels == 1 ? "Y" : colours.at(i);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, slice(numbers, i));
    }
    Memory memory;
    {
        Imf::OutputFile file(memory, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(numbers.height);
    }
    return std::move(memory.file);
}

std::optional<Numbers> decode_exr(std::span<const std::uint8_t> bytes) {
    try {
        Bytes stream(bytes);
        Imf::InputFile file(stream, 0);
        return read(file);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace reprise::render
