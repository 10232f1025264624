#include "cli/external/serve_places.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <sys/mman.h>

#include "world/check.h"

namespace reprise::cli {

using Place = std::atomic<std::uint64_t>;
static_assert(Place::is_always_lock_free, "a session that is killed must not hold a lock");

Places::Places(std::size_t most) {
    void* const memory = mmap(
        nullptr, most * sizeof(Place), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        throw world::Error(std::string("no memory for the places of clients: ") +
                           std::strerror(errno));
    auto* const first = static_cast<Place*>(memory);
    for (std::size_t i = 0; i < most; ++i)
        new (first + i) Place(0);
    all_ = {first, most};
}

Places::~Places() {
    munmap(all_.data(), all_.size_bytes());
}

bool Places::take(std::uint64_t who) {
    return std::any_of(all_.begin(), all_.end(), [&](Place& one) {
        std::uint64_t nobody = 0;
        return one.compare_exchange_strong(nobody, who);
    });
}

bool Places::has(std::uint64_t who) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Place& one) { return one == who; });
}

void Places::free(std::uint64_t who) {
    for (Place& one : all_) {
        std::uint64_t taken = who;
        one.compare_exchange_strong(taken, 0);
    }
}

}  // namespace reprise::cli
