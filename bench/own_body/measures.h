// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/csv.h"

namespace sigs::bench {

// Both methods on every made flight, through H.264 files: flights.csv, and an image of each in flights/.
void measure_flights(const accuracy::Call& call);

// The same on flights beyond what is asked for: limits.csv.
void measure_limits(const accuracy::Call& call);

// Agreement by run time, frames, `every` and early stop: time.csv.
void measure_time(const accuracy::Call& call);

// What stopping early saves and costs, on the made flights that can be told: early.csv.
void measure_early_stop(const accuracy::Call& call);

// Real clips, and shapes laid over one of them: real.csv, overlays in real/. Says so where there are none.
void measure_real_clips(const accuracy::Call& call);

// How often a pixel is body by the confidence that it is, tenth by tenth, over flights that the weights were set by and
// over flights that nothing was set by: reliability.csv; agreement on these: reflections.csv, images in reliability/.
void measure_reliability(const accuracy::Call& call);

// What the page shows: flights.jpg of what measure_flights left, stages-paper.jpg, stages-stable.jpg, real-masks.png of
// what measure_real_clips left.
void draw_images(const accuracy::Call& call);

}  // namespace sigs::bench
