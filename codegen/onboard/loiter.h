@HEAD@
#ifndef LOITER_ONBOARD_H
#define LOITER_ONBOARD_H

#include <stdint.h>

#ifndef __cplusplus
#include <stdbool.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Single precision with -DLOITER_FLOAT, which the program that includes this file needs too; otherwise double. */
#ifdef LOITER_FLOAT
typedef float loiter_real;
typedef int32_t loiter_integer;
#else
typedef double loiter_real;
typedef int64_t loiter_integer;
#endif

/* Statuses. LOITER_OK is 0; all others say why there is no answer. */
enum {
@STATUSES@
    /* `dt_s` of a step is not a positive, finite number. */
    LOITER_BAD_STEP = 14,
    /* Roll response, delay, reserve, smoothing or gain is what no aircraft has. */
    LOITER_BAD_RESPONSE = 15,
    /* A search is not complete yet. */
    LOITER_SEARCHING = 16
};

/* The direction in which the circle is flown, seen from above. */
enum { LOITER_CW = 1, LOITER_CCW = -1, LOITER_EITHER = 0 };

/* What a command, or a piece of an entry, does. */
enum { LOITER_RIGHT = -1, LOITER_STRAIGHT = 0, LOITER_LEFT = 1, LOITER_HOLD = 2, LOITER_NO_DATA = 3 };

/* ---- The fastest entry ------------------------------------------------------------------------------------------ */

/* An entry to find. Lengths are in turn radii of the aircraft, speeds in airspeeds, times in turn radii over airspeed.
 *
 * (x, y) is the position from the circle's centre and (c, s) the heading as a unit vector, in the same axes, of which
 * the second is 90 degrees counter-clockwise from the first, seen from above: east and north, say. (wx, wy) is the
 * velocity of the air past the circle: the wind less the velocity of the circle. A start beyond the circle or beyond a
 * last arc by less than `tolerance` counts as on it. */
typedef struct {
    loiter_real x, y, c, s, radius;
    int side;
    loiter_real wx, wy, tolerance;
} loiter_problem;

/* An entry: the side of its circle, the number of its pieces, at most 3, and their controls (LOITER_LEFT and so on) and
 * durations. */
typedef struct {
    int side, pieces, controls[3];
    loiter_real durations[3];
} loiter_entry;

/* The fastest entry; its status. In still air it takes the same few thousand instructions for every start, in wind a
 * search whose length depends on the start: docs/onboard.md has counts. */
int loiter_fastest(const loiter_problem *problem, loiter_entry *entry);

/* A search, which may be spread over several calls; it contains no pointers, so that it may be copied and moved. */
@SEARCH@

typedef struct {
    loiter_WindSearch state;
} loiter_search;

/* Begin a search; LOITER_OK, or why there is nothing to search. A search in still air is complete at once. */
int loiter_search_begin(loiter_search *search, const loiter_problem *problem);

/* Continue a search by at most `steps` steps: LOITER_SEARCHING while it is not complete, and then status and entry of
 * `loiter_fastest`, to the last bit. docs/onboard.md says how long a step takes, and how many a search may need. */
int loiter_search_step(loiter_search *search, int steps, loiter_entry *entry);

/* ---- The guidance law ------------------------------------------------------------------------------------------- */

/* What a law is made for.
 *
 * Everything is relative to the centre of the circle. Where that moves, its velocity is to be subtracted from all
 * velocities over the ground, and from the wind. The wind is a velocity towards the east and the north; 0 where none is
 * known. The roll response is a first-order lag with a limited rate; the delay is that between a command and the first
 * measurement that shows it. A step of the law takes at most `search_steps` steps of a search in wind, and the next
 * steps continue it; with 0 it makes whole searches. */
typedef struct {
    loiter_real radius_m;
    int side;
    loiter_real airspeed_m_s, bank_limit_deg;
    loiter_real roll_time_s, roll_rate_deg_s, delay_s;
    loiter_real wind_east_m_s, wind_north_m_s;
    loiter_real reserve, smoothing_s, gain;
    int search_steps;
} loiter_law_config;

/* A measurement: a time stamp in microseconds that may wrap around, the position from the circle's centre, metres, at
 * most some 20 km, heading of the nose (compass degrees), bank (degrees, positive to the right), velocity relative to
 * the circle's centre, and true airspeed. */
typedef struct {
    uint32_t time_us;
    loiter_real east_m, north_m, heading_deg, bank_deg, velocity_east_m_s, velocity_north_m_s, airspeed_m_s;
} loiter_measurement;

/* A command: turn rate and bank (positive to the right), what it does (LOITER_LEFT and so on, LOITER_NO_DATA where there
 * is no usable measurement), the time until the circle is joined, the side of the circle, 0 before it is known, what
 * comes next, and when. Times are nan where there is no data. */
typedef struct {
    loiter_real turn_rate_deg_s, bank_deg;
    int phase;
    loiter_real time_to_join_s;
    int side, next_phase;
    loiter_real next_in_s;
} loiter_command;

/* The structures of which the state of the law consists. No program needs to read them. */
@STRUCTURES@

/* The state of a law; it contains no pointers, so that it may be copied and moved. `estimates` of `vehicle` are what is
 * known of the vehicle; a program that identifies more than is declared writes it there and adds 1 to `revision`. */
typedef struct {
    loiter_Settings settings;
    loiter_VehicleModel vehicle;
    loiter_Memory memory;
    loiter_Rings rings;
    uint32_t begin_us;
} loiter_law;

/* A configuration with the values that the simulations of docs/guidance.md use, in still air. */
loiter_law_config loiter_law_defaults(loiter_real airspeed_m_s, loiter_real bank_limit_deg, loiter_real radius_m,
                                      int side);

/* Begin with wings level and without a plan; the status, LOITER_OK unless a value makes no sense or the circle cannot be
 * held, and then the law must not be used. To be called again whenever the circle changes. */
int loiter_law_begin(loiter_law *law, const loiter_law_config *config);

/* The command for the next `dt_s` seconds. Without a new measurement the last one is to be given again. With a status
 * other than LOITER_OK law and command are unchanged. */
int loiter_law_step(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s, loiter_command *command);

/* The same for the vehicle that has been written to `law->vehicle`, with the bank at the end of the last command; for
 * loiter_identification.c, and for identification of one's own. */
int loiter_law_step_known(loiter_law *law, const loiter_measurement *measurement, loiter_real dt_s,
                          loiter_command *command);

#ifdef __cplusplus
}
#endif
#endif
