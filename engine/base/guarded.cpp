// SPDX-License-Identifier: MIT
#include "base/guarded.h"

#include <new>
#include <opencv2/core.hpp>
#include <system_error>

namespace sigs {

namespace {

Error sorted(const std::string& where) {
  if (is_out_of_memory())
    return {where, "out of memory; smaller inputs and fewer jobs at a time need less", ErrorKind::unavailable};
  try {
    throw;
  } catch (const cv::Exception& problem) {
    return {where, problem.err.empty() ? problem.what() : problem.err};
  } catch (const std::system_error& problem) {
    const bool no_more = problem.code() == std::errc::resource_unavailable_try_again;
    return {where, problem.what(), no_more ? ErrorKind::unavailable : ErrorKind::bad_data};
  } catch (const std::exception& problem) {
    return {where, problem.what()};
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
    return sorted(where);
  } catch (...) {  // not even memory for the words: these few need none
    return {{}, "out of memory", ErrorKind::unavailable};
  }
}

}  // namespace sigs
