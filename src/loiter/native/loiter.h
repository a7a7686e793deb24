/* The fastest way onto a holding circle: the functions that other programs call.
 *
 * Lengths are in turn radii, times in turn radii over airspeed, angles mathematical: radians, counter-clockwise. Words,
 * sides and statuses are the codes of `enum`s in kernel.h; `docs/theory.md` and `docs/wind.md` define the rest. No
 * function keeps anything between calls, allocates memory or sets errno on purpose, so that all may be called from
 * several threads.
 *
 * Build: cc -std=c99 -O2 -ffp-contract=off -c loiter.c, and link with -lm. Without -ffp-contract=off, or with
 * -ffast-math, the answers lose digits next to the boundaries of the synthesis.
 */
#ifndef LOITER_H
#define LOITER_H

#ifdef __cplusplus
extern "C" {
#endif

/* A maneuver in still air: the side of its circle (1 clockwise, -1 counter-clockwise), its word, and the durations of
 * its pieces, 0 past the last. */
typedef struct {
    int side, word;
    double t1, t2, t3;
} loiter_entry;

/* An entry to find in wind: start from the circle's centre, heading as a unit vector, radius, side (0 for either),
 * velocity of the air past the circle over the airspeed, and the length by which the start may lie beyond the circle or
 * a last arc and count as on it. */
typedef struct {
    double x, y, c, s, R;
    int side;
    double wx, wy, tolerance;
} loiter_wind_problem;

/* A maneuver in wind: status, side, word, durations, azimuth of the point of joining, and the distance from it at which
 * the maneuver ends when flown exactly. */
typedef struct {
    int status, side, word;
    double t1, t2, t3, azimuth, miss;
} loiter_wind_entry;

/* The fastest maneuver from the reduced state (x, y) onto the circle of radius R in still air; the status, 0 where there
 * is one. A side of 0 leaves the side free. */
int loiter_optimum(double x, double y, double R, int side, double tolerance, loiter_entry *entry);

/* The least time of `loiter_optimum`, nan where its status is not 0; a piece too short to be flown may be included. */
double loiter_least_time(double x, double y, double R, int side, double tolerance);

/* The distance from the target at which a maneuver from (x, y) ends when flown exactly. */
double loiter_miss(double x, double y, double R, const loiter_entry *entry);

/* The derivatives of the least time with respect to x, y and R: those of the maneuver of `loiter_optimum` without a
 * tolerance; nan where its status is not 0, and at the target. */
void loiter_gradient(double x, double y, double R, int side, double gradient[3]);

/* The controls of the three pieces of a word: 1 left, 0 straight, -1 right, -2 past its last. */
void loiter_controls(int word, int u[3]);

/* The fastest maneuver in wind; its floats are nan where its status is not 0. */
loiter_wind_entry loiter_fastest_in_wind(const loiter_wind_problem *problem);

/* The points of joining around the circle between which `loiter_local_minima` looks for local minima. */
#define LOITER_SAMPLES 128

/* The maneuvers at the local minima of the time over the point of joining, on the side of the problem, which is 1 or
 * -1; their number. To be called only where the status of `loiter_fastest_in_wind` is 0. */
int loiter_local_minima(const loiter_wind_problem *problem, loiter_wind_entry entries[LOITER_SAMPLES]);

/* The first arrival in a slot, a point of the circle that moves round it with the hold: that at `phase` at the time 0,
 * the angle flown since the heading was against the wind, or with the wind towards the direction of (1, 0) in still air.
 * The side of the problem is 1 or -1. */
loiter_wind_entry loiter_first_in_slot(const loiter_wind_problem *problem, double phase);

/* The durations of the first path of a word of three pieces, by its code, to a pose at rest over the ground, which is
 * passed in the direction `track`, radians: from (x, y) relative to the pose with the heading (c, s). The first is
 * infinite where there is no path. */
void loiter_path_to_pose(int word, double x, double y, double c, double s, double track, double wx, double wy,
                         double durations[3]);

#ifdef __cplusplus
}
#endif
#endif
