// SPDX-License-Identifier: MIT
#include "base/threads.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>  // defines __GLIBC__ where it is glibc
#include <exception>
#include <new>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sigs {

namespace {

#ifdef __SANITIZE_THREAD__
// OpenCV shares its loops among TBB's threads. TBB is not instrumented, so that ThreadSanitizer does not see its locks:
// under it each loop runs on the thread that asks for it.
[[maybe_unused]] const bool loops_are_not_shared = (cv::setNumThreads(1), true);
#endif

std::terminate_handler end_otherwise = nullptr;
[[noreturn]] void end_program() {
  constexpr std::string_view kLine = "error: out of memory; smaller inputs and fewer jobs at a time need less\n";
  if (std::current_exception() == nullptr || !is_out_of_memory()) {
    end_otherwise();
    std::abort();
  }
  static_cast<void>(!write(STDERR_FILENO, kLine.data(), kLine.size()));
  _exit(static_cast<int>(ErrorKind::unavailable));
}

// What TBB throws, by which OpenCV shares its loops among threads: a plain runtime_error without a code.
bool is_thread_not_started(const std::exception& problem) {
  return std::string_view(problem.what()).starts_with("pthread_create has failed");
}

// Where there is no memory for a longer message: this one needs none.
Error out_of_memory() {
  return {{}, "out of memory", ErrorKind::unavailable};
}

Error error_of_exception(const std::string& where) {
  if (is_out_of_memory())
    return {where, "out of memory; smaller inputs and fewer jobs at a time need less", ErrorKind::unavailable};
  try {
    throw;
  } catch (const cv::Exception& problem) {
    return {where, problem.err.empty() ? problem.what() : problem.err};
  } catch (const std::system_error& problem) {
    const bool no_more = problem.code() == std::errc::resource_unavailable_try_again ||
                         problem.code() == std::error_code(ELIBACC, std::generic_category());
    return {where, problem.what(), no_more ? ErrorKind::unavailable : ErrorKind::bad_data};
  } catch (const std::exception& problem) {
    return {where, problem.what(), is_thread_not_started(problem) ? ErrorKind::unavailable : ErrorKind::bad_data};
  } catch (...) {
    return {where, "failed for a reason that is not known"};
  }
}

}  // namespace

bool is_out_of_memory() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return true;
  } catch (const cv::Exception& problem) {
    return problem.code == cv::Error::StsNoMem;
  } catch (...) {
    return false;
  }
}

Error thrown_error(const std::string& where) {
  try {
    return error_of_exception(where);
  } catch (...) {
    return out_of_memory();
  }
}

Error thread_not_started() {
  try {
    const char* const why = is_out_of_memory() ? "out of memory" : "the system's limit of threads or memory is reached";
    return {{}, std::string("no more threads can be started: ") + why, ErrorKind::unavailable};
  } catch (...) {
    return out_of_memory();
  }
}

void run_in_background(const std::function<void()>& body) {
  if (Result<std::thread> thread = started_thread(body))
    thread->detach();
  else
    body();
}

void tune_allocator() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the maximum that glibc accepts
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_ARENA_MAX, 2);
#endif
}

void end_plainly_without_memory() {
  end_otherwise = std::set_terminate(end_program);
}

bool has_free_memory(std::size_t bytes) {
  void* const mapping = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapping == MAP_FAILED) return false;
  munmap(mapping, bytes);
  return true;
}

}  // namespace sigs
