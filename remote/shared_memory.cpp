#include "remote/shared_memory.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>

#include "world/check.h"

namespace reprise::remote {

namespace {

constexpr int size_seals = F_SEAL_SHRINK | F_SEAL_GROW;

[[noreturn]] void throw_no_memory() {
    throw world::Error(std::string("no memory to share: ") + std::strerror(errno));
}

}  // namespace

SharedMemory::SharedMemory(std::size_t bytes)
    : descriptor_(memfd_create("reprise", MFD_CLOEXEC | MFD_ALLOW_SEALING)),
      size_(bytes) {
    if (descriptor() < 0 || ftruncate(descriptor(), static_cast<off_t>(bytes)) != 0 ||
        fcntl(descriptor(), F_ADD_SEALS, size_seals | F_SEAL_SEAL) != 0)
        throw_no_memory();
    map(Use::write);
}

SharedMemory::SharedMemory(Descriptor descriptor, std::size_t bytes, Use use)
    : descriptor_(std::move(descriptor)),
      size_(bytes) {
    struct stat facts {};

    const int seals = fcntl(descriptor_.number(), F_GET_SEALS);
    if (fstat(descriptor_.number(), &facts) != 0 || seals < 0 ||
        (seals & size_seals) != size_seals ||
        static_cast<std::uint64_t>(facts.st_size) < std::uint64_t{bytes})
        throw world::Error("the shared memory is not as large as was said, or can be cut off");
    map(use);
}

SharedMemory::~SharedMemory() {
    munmap(start_, size_);
}

void SharedMemory::map(Use use) {
    const int rights = use == Use::write ? PROT_READ | PROT_WRITE : PROT_READ;
    void* start = mmap(nullptr, size_, rights, MAP_SHARED, descriptor(), 0);
    if (start == MAP_FAILED)
        throw_no_memory();
    start_ = static_cast<std::uint8_t*>(start);
}

Descriptor SharedMemory::for_looking() const {
    const std::string path = "/proc/self/fd/" + std::to_string(descriptor());
    Descriptor looking(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (looking.number() < 0)
        throw_no_memory();
    return looking;
}

}  // namespace reprise::remote
