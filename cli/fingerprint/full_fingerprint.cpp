#include "cli/fingerprint/full_fingerprint.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <link.h>
#include <string_view>

#include <fmt/format.h>

#include "world/fingerprint.h"

namespace reprise::cli {

namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

constexpr std::array deciding{
    "libsumocpp", "libBullet", "libLinearMath", "liblua", "libDetour", "libRecast"};

/// The notes of a loaded file: (name size, content size, type), name, content, each padded to 4.
std::string build_id(const char* notes, std::size_t size) {
    std::size_t at = 0;
    while (at + sizeof(ElfW(Nhdr)) <= size) {
        ElfW(Nhdr) note;
        std::memcpy(&note, notes + at, sizeof(note));
        const char* name = notes + at + sizeof(note);
        const char* content = name + (note.n_namesz + 3U) / 4U * 4U;
        if (note.n_type == NT_GNU_BUILD_ID && std::string_view(name, 3) == "GNU") {
            std::string text;
            for (unsigned i = 0; i < std::min(note.n_descsz, 8U); ++i)
                text += fmt::format("{:02x}", static_cast<unsigned char>(content[i]));
            return text;
        }
        at = static_cast<std::size_t>(content - notes) + (note.n_descsz + 3U) / 4U * 4U;
    }
    return "";
}

int note_library(dl_phdr_info* file, std::size_t, void* lines) {
    const std::string name = std::filesystem::path(file->dlpi_name).filename().string();
    const std::string stem = name.substr(0, name.find(".so"));
    if (std::none_of(deciding.begin(), deciding.end(), [&](const char* start) {
            return name.starts_with(start);
        }))
        return 0;
    std::string id;
    for (int i = 0; i < file->dlpi_phnum && id.empty(); ++i) {
        const ElfW(Phdr)& part = file->dlpi_phdr[i];
        if (part.p_type == PT_NOTE)
            id = build_id(reinterpret_cast<const char*>(file->dlpi_addr + part.p_vaddr),
                          part.p_memsz);
    }
    static_cast<Lines*>(lines)->emplace_back(stem, id.empty() ? "no build id" : id);
    return 0;
}

}  // namespace

Lines full_fingerprint() {
    Lines lines;
    dl_iterate_phdr(note_library, &lines);
    std::sort(lines.begin(), lines.end());
    Lines all = world::build_fingerprint();
    all.insert(all.end(), lines.begin(), lines.end());
    return all;
}

}  // namespace reprise::cli
