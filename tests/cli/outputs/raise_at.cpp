// Preloaded into a program: a signal comes at its n-th call that makes, changes or names a file.
// So every moment that matters is met, and each of them again in the next run.
//   RAISE_AT      which call, from 1
//   RAISE_SIGNAL  its number
//   RAISE_AFTER   set: behind the call, else before it
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

int number(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? 0 : std::atoi(text);
}

/// Whether this call is the one, counted over all threads.
bool is_the_one() {
    static const int wanted = number("RAISE_AT");
    static int calls = 0;
    return __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) == wanted;
}

template <typename Function, typename... Arguments>
auto call(const char* name, Arguments... arguments) {
    const auto function = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
    const bool now = is_the_one();
    const bool after = std::getenv("RAISE_AFTER") != nullptr;
    if (now && !after)
        kill(getpid(), number("RAISE_SIGNAL"));
    const auto result = function(arguments...);
    if (now && after)
        kill(getpid(), number("RAISE_SIGNAL"));
    return result;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    const auto original =
        reinterpret_cast<int (*)(const char*, int, mode_t)>(dlsym(RTLD_NEXT, "open"));
    if ((flags & O_CREAT) == 0)
        return original(path, flags, mode);
    return call<int (*)(const char*, int, mode_t)>("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open(path, flags, mode);
}

int mkdir(const char* path, mode_t mode) noexcept {
    return call<int (*)(const char*, mode_t)>("mkdir", path, mode);
}

int rename(const char* from, const char* to) noexcept {
    return call<int (*)(const char*, const char*)>("rename", from, to);
}

int ftruncate(int file, off_t size) noexcept {
    return call<int (*)(int, off_t)>("ftruncate", file, size);
}

int fdatasync(int file) {
    return call<int (*)(int)>("fdatasync", file);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
    if (file <= STDERR_FILENO)
        return reinterpret_cast<ssize_t (*)(int, const void*, std::size_t)>(
            dlsym(RTLD_NEXT, "write"))(file, bytes, size);
    return call<ssize_t (*)(int, const void*, std::size_t)>("write", file, bytes, size);
}
}
