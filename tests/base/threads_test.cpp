// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <future>
#include <memory>
#include <new>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "base/threads.h"

using namespace sigs;

namespace {

// The error that results from an exception in a job.
template <class Thrown>
Error error_of(const Thrown& thrown) {
  const Result<int> result = guarded([&]() -> Result<int> { throw thrown; }, "job");
  REQUIRE_FALSE(result);
  return result.error();
}

}  // namespace

TEST_CASE("guarded() returns the value or the error of the job") {
  CHECK(guarded([]() -> Result<int> { return 7; }).value() == 7);
  const Result<int> failed = guarded([]() -> Result<int> { return fail("here", "is wrong", ErrorKind::usage); });
  REQUIRE_FALSE(failed);
  CHECK(failed.error().text() == "here: is wrong");
  CHECK(failed.error().kind == ErrorKind::usage);
}

TEST_CASE("lack of memory gives the error unavailable, whichever code requested it") {
  for (const Error& error :
       {error_of(std::bad_alloc()), error_of(std::bad_array_new_length()),
        error_of(cv::Exception(cv::Error::StsNoMem, "Failed to allocate 12 bytes", "f", "alloc.cpp", 1))}) {
    CHECK(error.kind == ErrorKind::unavailable);
    CHECK(error.where == "job");
    CHECK(error.what.find("out of memory") != std::string::npos);
  }
}

TEST_CASE("other exceptions keep their message") {
  CHECK(error_of(std::runtime_error("is odd")).text() == "job: is odd");
  CHECK(error_of(cv::Exception(cv::Error::StsBadArg, "is no image", "f", "x.cpp", 1)).text() == "job: is no image");
  CHECK(error_of(std::runtime_error("is odd")).kind == ErrorKind::bad_data);
  CHECK_FALSE(error_of(42).what.empty());
  const auto no_more = std::make_error_code(std::errc::resource_unavailable_try_again);
  CHECK(error_of(std::system_error(no_more)).kind == ErrorKind::unavailable);
  CHECK(error_of(std::system_error(ELIBACC, std::generic_category(), "no library")).kind == ErrorKind::unavailable);
  // In the words of TBB, whose exceptions have no code.
  CHECK(error_of(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")).kind ==
        ErrorKind::unavailable);
}

TEST_CASE("a started thread runs its function") {
  int done = 0;
  Result<std::thread> thread = started_thread([&] { done = 5; });
  REQUIRE(thread);
  thread->join();
  CHECK(done == 5);
}

TEST_CASE("what a thread's body throws is handed over as an error") {
  for (const bool throws : {false, true}) {
    std::string told;
    const auto body = [&] {
      if (throws) throw std::runtime_error("is odd");
    };
    Result<std::thread> thread = started_thread(body, [&](Error error) { told = error.text(); });
    REQUIRE(thread);
    thread->join();
    CHECK(told == (throws ? "is odd" : ""));
  }
}

// A body for which there is no memory as soon as it is moved into its thread.
struct BodyWithoutMemory {
  BodyWithoutMemory() = default;
  BodyWithoutMemory(const BodyWithoutMemory&) = default;
  BodyWithoutMemory(BodyWithoutMemory&&) { throw std::bad_alloc(); }  // NOLINT(performance-noexcept-move-constructor)
  void operator()() const {}
};

TEST_CASE("a thread for which there is no memory is an error: nothing is thrown") {
  const BodyWithoutMemory body;
  const Result<std::thread> plain = started_thread(body);
  REQUIRE_FALSE(plain);
  CHECK(plain.error().kind == ErrorKind::unavailable);
  CHECK(plain.error().text() == "no more threads can be started: out of memory");
}

TEST_CASE("a thread hands its error over to keep: a copy of it might find no memory") {
  const std::string long_text(1000, 'x');
  std::optional<Error> kept;
  const auto keep = [&](auto&& error) {
    static_assert(std::is_rvalue_reference_v<decltype(error)>);
    kept = std::move(error);
  };
  Result<std::thread> thread = started_thread([&] { throw std::runtime_error(long_text); }, keep);
  REQUIRE(thread);
  thread->join();
  REQUIRE(kept);
  CHECK(kept->what == long_text);
}

TEST_CASE("work in the background is done although nobody joins its thread") {
  const auto done = std::make_shared<std::promise<int>>();
  run_in_background([done] { done->set_value(5); });
  CHECK(done->get_future().get() == 5);
}
