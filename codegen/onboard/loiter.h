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

/* Single precision with -DLOITER_FLOAT; otherwise double. Every file that includes this one needs the same: the functions
 * in single precision have names of their own, so that files of both kinds do not link. */
#ifdef LOITER_FLOAT
typedef float loiter_real;
typedef int32_t loiter_integer;
#define loiter_fastest loiter_fastest_float
#define loiter_search_begin loiter_search_begin_float
#define loiter_search_step loiter_search_step_float
#define loiter_law_defaults loiter_law_defaults_float
#define loiter_law_begin loiter_law_begin_float
#define loiter_law_step loiter_law_step_float
#define loiter_law_step_known loiter_law_step_known_float
#define loiter_identification_begin loiter_identification_begin_float
#define loiter_law_step_identified loiter_law_step_identified_float
#else
typedef double loiter_real;
typedef int64_t loiter_integer;
#endif

/* Statuses. LOITER_OK is 0; all others say why there is no answer. */
enum {
@STATUSES@
    /* `dt_s` of a step is not above 0 and at most LOITER_LONGEST_STEP_S. */
    LOITER_BAD_STEP = 14,
    /* The roll response, delay, reserve, smoothing, gain or search_steps is negative or out of range. */
    LOITER_BAD_RESPONSE = 15,
    /* A search is not complete yet: continue it in the next cycle. */
    LOITER_SEARCHING = 16
};

/* The longest step, seconds: a command that lasted longer would say nothing, and one of 1e38 s overflows. */
#define LOITER_LONGEST_STEP_S @LONGEST_STEP@

/* The direction in which the circle is flown, seen from above. */
enum { LOITER_CW = 1, LOITER_CCW = -1, LOITER_EITHER = 0 };

/* What a command, or a piece of an entry, does. LOITER_RIGHT is negative, though a bank to the right is positive:
 * compare with these names, not with signs. */
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
 * durations, in turn radii over airspeed. */
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
 * velocities over the ground, and from the wind. */
typedef struct {
    loiter_real radius_m;
    int side; /* LOITER_CW, LOITER_CCW or LOITER_EITHER */
    /* The true airspeed at cruise, and the largest bank of a command, of any turn, also on the circle. */
    loiter_real airspeed_m_s, bank_limit_deg;
    /* The roll response, a first-order lag with a limited rate, and the delay between a command and the first
     * measurement that shows it. */
    loiter_real roll_time_s, roll_rate_deg_s, delay_s;
    /* By how much the command may change in a second, at most; infinite by default. Where the autopilot limits the rate
     * of its bank setpoint, as PX4 does (FW_PN_R_SLEW_MAX), give that limit, degrees per second. */
    loiter_real roll_slew_deg_s;
    /* The velocity of the air towards the east and the north: positive east for a wind from the west. 0 where none is
     * known. */
    loiter_real wind_east_m_s, wind_north_m_s;
    /* For experiments; leave the defaults. By which share planned turns are wider than the tightest, the shortest
     * averaging time of measurements, and the gain of course corrections, without a unit. */
    loiter_real reserve, smoothing_s, gain;
    /* The steps of a search in wind that a step of the law takes at most; the next steps continue it. With 0 it makes
     * whole searches. */
    int search_steps;
} loiter_law_config;

/* A measurement; every field is needed. */
typedef struct {
    uint32_t time_us;                                    /* may wrap around */
    loiter_real east_m, north_m;                         /* from the circle's centre, at most some 20 km */
    loiter_real heading_deg;                             /* of the nose: 0 is north, 90 east; any range */
    loiter_real bank_deg;                                /* positive to the right */
    loiter_real velocity_east_m_s, velocity_north_m_s;   /* over the ground, less the velocity of the circle's centre */
    loiter_real airspeed_m_s;                            /* true airspeed */
} loiter_measurement;

/* A command. Times are nan where the phase is LOITER_NO_DATA: there is no usable measurement, or the first search is
 * not complete. */
typedef struct {
    loiter_real turn_rate_deg_s, bank_deg; /* positive to the right; fly the bank */
    int phase;                             /* LOITER_RIGHT, STRAIGHT, LEFT, HOLD or NO_DATA */
    loiter_real time_to_join_s;            /* 0 on the circle */
    int side;                              /* LOITER_CW or LOITER_CCW, 0 before it is known */
    int next_phase;
    loiter_real next_in_s;                 /* infinite on the circle */
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

/* A configuration with the values that the simulations of docs/guidance.md use, in still air, with whole searches. */
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
