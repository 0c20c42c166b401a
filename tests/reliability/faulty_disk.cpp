// SPDX-License-Identifier: MIT
// A library to preload (LD_PRELOAD) that makes one operation on a regular file go wrong. The operations are counted
// from 1: creating a file, writing to it, closing it, renaming it. VANTAGE_FAULT says what happens at which one:
//
//     fail:N  it fails once with "No space left on device"
//     full:N  it fails, and so does every later operation except closing
//     half:N  the same, but a write stores half of its bytes first
//     kill:N  the process is killed before it; a write stores half of its bytes first
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

enum class Fault : unsigned char { None, Fail, Full, Half, Kill };

struct Wanted {
  Fault fault = Fault::None;
  long at = 0;

  Wanted() {
    const char* const text = std::getenv("VANTAGE_FAULT");
    const std::string_view given = text == nullptr ? "" : text;
    const std::size_t colon = given.find(':');
    if (colon == std::string_view::npos) {
      return;
    }
    const std::string_view name = given.substr(0, colon);
    fault = name == "fail" ? Fault::Fail : name == "full" ? Fault::Full : name == "half" ? Fault::Half : Fault::Kill;
    at = std::strtol(text + colon + 1, nullptr, 10);
  }
};

const Wanted& wanted() {
  static const Wanted instance;
  return instance;
}

// What happens to the next operation.
Fault next_fault() {
  static std::atomic<long> count{0};
  const Wanted& given = wanted();
  const long number = ++count;
  if (number == given.at) {
    return given.fault;
  }
  const bool stays = given.fault == Fault::Full || given.fault == Fault::Half;
  return stays && number > given.at ? Fault::Full : Fault::None;
}

bool is_regular(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

int no_space() {
  errno = ENOSPC;
  return -1;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void die() {
  (void)::raise(SIGKILL);
  std::abort();  // never reached
}

int opened(const char* name, const char* path, int flags, unsigned mode) {
  static auto* const real_open = real<int(const char*, int, ...)>(name);
  struct stat status {};
  const bool regular = ::stat(path, &status) != 0 || S_ISREG(status.st_mode);
  if ((flags & O_CREAT) != 0 && regular) {
    const Fault fault = next_fault();
    if (fault == Fault::Kill) {
      die();
    }
    if (fault != Fault::None) {
      return no_space();
    }
  }
  return real_open(path, flags, mode);
}

}  // namespace

// NOLINTBEGIN(cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg): the functions of the C library
extern "C" int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(arguments, unsigned) : 0U;
  va_end(arguments);
  return opened("open", path, flags, mode);
}

extern "C" int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(arguments, unsigned) : 0U;
  va_end(arguments);
  return opened("open64", path, flags, mode);
}
// NOLINTEND(cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg)

extern "C" ssize_t write(int file, const void* bytes, std::size_t count) {
  static auto* const real_write = real<ssize_t(int, const void*, std::size_t)>("write");
  if (!is_regular(file)) {
    return real_write(file, bytes, count);
  }
  const Fault fault = next_fault();
  if ((fault == Fault::Half || fault == Fault::Kill) && count > 1) {
    const ssize_t written = real_write(file, bytes, count / 2);
    if (fault == Fault::Half) {
      return written;
    }
  }
  if (fault == Fault::Kill) {
    die();
  }
  return fault == Fault::None ? real_write(file, bytes, count) : no_space();
}

extern "C" int close(int file) {
  static auto* const real_close = real<int(int)>("close");
  const int flags = ::fcntl(file, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY || !is_regular(file)) {
    return real_close(file);
  }
  const Fault fault = next_fault();
  if (fault == Fault::Kill) {
    die();
  }
  const int closed = real_close(file);
  return fault == Fault::Fail ? no_space() : closed;
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static auto* const real_rename = real<int(const char*, const char*)>("rename");
  const Fault fault = next_fault();
  if (fault == Fault::Kill) {
    die();
  }
  return fault == Fault::None ? real_rename(from, to) : no_space();
}
