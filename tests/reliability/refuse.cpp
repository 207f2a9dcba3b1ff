// A library to preload: the n-th call of a function of the system fails, as REFUSE says.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// REFUSE=malloc:17 refuses the 17th call, malloc:17+ every one from the 17th on. "malloc" is every
// way of asking for memory. threads:17 refuses a thread while 17 live, as a limit of the system
// does. eglInitialize and glCompileShader fail as a driver lets them. REFUSE_COUNT=FILE writes how
// many calls there were, or the most threads that lived.
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <string_view>
#include <unistd.h>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
}

namespace {

std::atomic<long> calls{0};
std::atomic<long> living{0};

struct Order {
    char function[32] = {};
    long first = 0;
    bool onwards = false;

    Order() {
        const char* const text = ::getenv("REFUSE");
        const char* const colon = text ? std::strchr(text, ':') : nullptr;
        if (!colon || colon - text >= static_cast<long>(sizeof function)) return;
        std::memcpy(function, text, static_cast<size_t>(colon - text));
        char* end = nullptr;
        first = std::strtol(colon + 1, &end, 10);
        onwards = *end == '+';
    }
};

/// Read on the first call, which is before any constructor.
const Order& theOrder() {
    static const Order order;
    return order;
}

/// Whether this call is to fail.
bool refused(const char* function) {
    const Order& order = theOrder();
    if (std::strcmp(order.function, function) != 0) return false;
    const long call = ++calls;
    return order.first > 0 && (call == order.first || (order.onwards && call > order.first));
}

using Lookup = void* (*)(void*, const char*);
using DriverLookup = void* (*)(const char*);

/// The system's own dlsym, which this library stands before.
Lookup systemLookup() {
    static const auto lookup =
        reinterpret_cast<Lookup>(::dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.2.5"));
    return lookup;
}

template<typename Function> Function* nextOf(const char* name) {
    return reinterpret_cast<Function*>(systemLookup()(RTLD_NEXT, name));
}

// The driver's functions, as they were looked up.
unsigned (*driverInitialize)(void*, int*, int*) = nullptr;
DriverLookup driverLookup = nullptr;
void (*driverCompile)(unsigned) = nullptr;

unsigned initialize(void* display, int* major, int* minor) {
    return refused("eglInitialize") ? 0 : driverInitialize(display, major, minor);
}

void compile(unsigned shader) {
    if (refused("glCompileShader")) {
        const char* const nonsense = "refused";
        reinterpret_cast<void (*)(unsigned, int, const char* const*, const int*)>(
            driverLookup("glShaderSource"))(shader, 1, &nonsense, nullptr);
    }
    driverCompile(shader);
}

void* lookUp(const char* name) {
    void* const found = driverLookup(name);
    if (found == nullptr || std::string_view(name) != "glCompileShader") return found;
    driverCompile = reinterpret_cast<void (*)(unsigned)>(found);
    return reinterpret_cast<void*>(compile);
}

[[gnu::destructor]] void tellCount() {
    const char* const path = ::getenv("REFUSE_COUNT");
    const int file = path ? ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (file < 0) return;
    char digits[24];
    char* at = digits + sizeof digits;
    *--at = '\n';
    for (long left = calls; at == digits + sizeof digits - 1 || left > 0; left /= 10)
        *--at = static_cast<char>('0' + left % 10);
    const auto length = static_cast<size_t>(digits + sizeof digits - at);
    static_cast<void>(nextOf<decltype(::write)>("write")(file, at, length));
    ::close(file);
}

struct Start {
    void* (*function)(void*);
    void* argument;
};

void* startCounted(void* start) {
    const Start what = *static_cast<Start*>(start);
    std::free(start);
    const auto leave = [](void*) { --living; };
    void* result = nullptr;
    pthread_cleanup_push(leave, nullptr);
    result = what.function(what.argument);
    pthread_cleanup_pop(1);
    return result;
}

/// Counts a thread in, unless that is one too many.
bool threadGranted() {
    const Order& order = theOrder();
    if (std::strcmp(order.function, "threads") != 0) return true;
    const long now = ++living;
    if (order.first > 0 && now > order.first) return --living, false;
    if (now > calls) calls = now;
    return true;
}

bool outOfMemory() {
    if (!refused("malloc")) return false;
    errno = ENOMEM;
    return true;
}

} // namespace

extern "C" {

void* malloc(size_t size) {
    return outOfMemory() ? nullptr : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
    return outOfMemory() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) {
    return outOfMemory() ? nullptr : __libc_realloc(old, size);
}

ssize_t write(int file, const void* bytes, size_t size) {
    static auto* const next = nextOf<decltype(::write)>("write");
    // What a tool says of it all is let through.
    const bool talk = file == STDERR_FILENO || ::memmem(bytes, size, ": error: ", 9) != nullptr;
    if (!talk && refused("write")) {
        errno = ENOSPC;
        return -1;
    }
    return next(file, bytes, size);
}

/// Libraries look the driver's functions up by name.
void* dlsym(void* library, const char* symbol) noexcept {
    void* const found = systemLookup()(library, symbol);
    const std::string_view name(symbol);
    if (found != nullptr && name == "eglInitialize") {
        driverInitialize = reinterpret_cast<unsigned (*)(void*, int*, int*)>(found);
        return reinterpret_cast<void*>(initialize);
    }
    if (found != nullptr && name == "eglGetProcAddress") {
        driverLookup = reinterpret_cast<DriverLookup>(found);
        return reinterpret_cast<void*>(lookUp);
    }
    return found;
}

int fsync(int file) {
    static auto* const next = nextOf<decltype(::fsync)>("fsync");
    if (!refused("fsync")) return next(file);
    errno = EIO;
    return -1;
}

int rename(const char* from, const char* to) noexcept {
    static auto* const next = nextOf<decltype(::rename)>("rename");
    if (!refused("rename")) return next(from, to);
    errno = EACCES;
    return -1;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
    static auto* const next = nextOf<decltype(::pthread_create)>("pthread_create");
    if (!threadGranted()) return EAGAIN;
    if (std::strcmp(theOrder().function, "threads") != 0)
        return next(thread, attributes, start, argument);
    auto* const counted = static_cast<Start*>(std::malloc(sizeof(Start)));
    if (counted == nullptr) return EAGAIN;
    *counted = {start, argument};
    return next(thread, attributes, startCounted, counted);
}
}
