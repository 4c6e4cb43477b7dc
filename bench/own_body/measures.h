// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/csv.h"

namespace sigs::bench {

// Both methods on every synthetic flight, through H.264 files: flights.csv, and an image of each in flights/.
void measure_flights(const accuracy::Call& call);

// The same on flights beyond the requirements: limits.csv.
void measure_limits(const accuracy::Call& call);

// Agreement by run time, frames, `every` and early stop: time.csv.
void measure_time(const accuracy::Call& call);

// Savings and cost of stopping early, on the decidable synthetic flights: early.csv.
void measure_early_stop(const accuracy::Call& call);

// Real clips, and shapes drawn over one of them: real.csv, overlays in real/. Says so where there are none.
void measure_real_clips(const accuracy::Call& call);

// How often a pixel is body by the confidence that it is, in tenths, over flights to which the weights were fitted and
// over flights to which nothing was fitted: reliability.csv; agreement on these: reflections.csv, images in
// reliability/.
void measure_reliability(const accuracy::Call& call);

// The images of the page: flights.jpg of what measure_flights left, stages-paper.jpg, stages-stable.jpg, real-masks.png
// of what measure_real_clips left.
void draw_images(const accuracy::Call& call);

}  // namespace sigs::bench
