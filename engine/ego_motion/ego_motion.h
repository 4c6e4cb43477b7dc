// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <opencv2/core.hpp>

#include "base/result.h"
#include "camera/camera.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

struct EgoMotionControl {
  std::function<void(int done, int total)> progress;  // frames; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
};

}  // namespace sigs
