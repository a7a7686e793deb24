/* The functions of loiter.h, by those generated from the Python of the kernel. */
#include "loiter.h"

#include "kernel.h"

static loiter_wind_entry exported(WindEntry entry) {
    return (loiter_wind_entry){(int)entry.status, (int)entry.side, (int)entry.word, entry.t1, entry.t2,
                               entry.t3,          entry.azimuth,   entry.miss};
}

static WindProblem imported(const loiter_wind_problem *p) {
    return (WindProblem){p->x, p->y, p->c, p->s, p->R, p->side, p->wx, p->wy, p->tolerance};
}

int loiter_optimum(double x, double y, double R, int side, double tolerance, loiter_entry *entry) {
    const int status = (int)synthesis_status_of(x, y, R, tolerance);
    if (status == STATUS_OK) {
        const Entry best = optimum(x, y, rounded_radius(R), side, tolerance);
        *entry = (loiter_entry){(int)best.side, (int)best.word, best.t1, best.t2, best.t3};
    }
    return status;
}

double loiter_least_time(double x, double y, double R, int side, double tolerance) {
    if (synthesis_status_of(x, y, R, tolerance) != STATUS_OK) {
        return NAN;
    }
    const double time = least_time(x, y, rounded_radius(R), side_or_near(y, side), tolerance);
    if (side != SIDE_EITHER || tolerance == 0.0) {
        return time;
    }
    return min_real(time, least_time(x, y, rounded_radius(R), -near_side(y), tolerance));
}

double loiter_miss(double x, double y, double R, const loiter_entry *e) {
    return miss(x, y, rounded_radius(R), (Entry){e->side, e->word, e->t1, e->t2, e->t3});
}

void loiter_gradient(double x, double y, double R, int side, double gradient[3]) {
    ValueGradient found = {NAN, NAN, NAN};
    if (synthesis_status_of(x, y, R, 0.0) == STATUS_OK) {
        const double radius = rounded_radius(R);
        found = value_gradient(x, y, radius, optimum(x, y, radius, side, 0.0));
    }
    gradient[0] = found.x;
    gradient[1] = found.y;
    gradient[2] = found.radius;
}

void loiter_controls(int word, int u[3]) {
    const integer_3 found = controls(word);
    u[0] = (int)found.a0;
    u[1] = (int)found.a1;
    u[2] = (int)found.a2;
}

loiter_wind_entry loiter_fastest_in_wind(const loiter_wind_problem *problem) {
    return exported(wind_search_fastest(imported(problem)));
}

loiter_wind_entry loiter_first_in_slot(const loiter_wind_problem *problem, double phase) {
    return exported(first_in_slot(imported(problem), phase));
}

int loiter_local_minima(const loiter_wind_problem *problem, loiter_wind_entry entries[LOITER_SAMPLES]) {
    const WindScene scene = scene_of(imported(problem));
    double times[LOITER_SAMPLES];
    int count = 0;
    sampled_times(problem->side, scene, times);
    for (int i = 0; i < LOITER_SAMPLES; i++) {
        if (is_local_minimum(times, i)) {
            entries[count++] = exported(entry_near_sample(i, problem->side, scene));
        }
    }
    return count;
}

void loiter_path_to_pose(int word, double x, double y, double c, double s, double track, double wx, double wy,
                         double durations[3]) {
    const Path path = path_to_pose(set_of(word), x, y, c, s, track, wx, wy);
    durations[0] = path.time < INFINITY ? path.t1 : INFINITY;
    durations[1] = path.t2;
    durations[2] = path.t3;
}
