/* The inner loops of wind_loops.c. */
#ifndef LOITER_WIND_LOOPS_H
#define LOITER_WIND_LOOPS_H

#include "loops.h"

extern loiter_loop loiter_min_time_in_wind, loiter_solve_in_wind, loiter_gradients, loiter_paths_to_poses;

#endif
