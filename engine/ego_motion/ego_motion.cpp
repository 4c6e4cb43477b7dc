// SPDX-License-Identifier: MIT
#include "ego_motion/ego_motion.h"
