/* The fastest way onto a holding circle, and the guidance law that flies it, for autopilots: docs/onboard.md.
 *
 * Double or single precision; no memory is allocated, nothing is kept between calls but what the caller holds, and
 * of the C library only math.h is needed. No function calls itself. Compile with -ffp-contract=off, and never with
 * -ffast-math.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: 2ec5ff08a51330b018d751c08ee9282012adc7c41ee57b3b3e1d40c13d79ba6d
 */
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
    /* There is an answer. */
    LOITER_OK = 0,
    /* A number of the problem is nan or infinite. */
    LOITER_NOT_FINITE = 1,
    /* The circle is below the least turn radius, airspeed^2 / (9.80665 * tan(bank limit)). */
    LOITER_RADIUS_TOO_SMALL = 2,
    /* The position or the radius is beyond 2^23 turn radii in single precision, 2^52 in double. */
    LOITER_OUT_OF_RANGE = 3,
    /* The tolerance is negative, or beyond the same bounds. */
    LOITER_BAD_TOLERANCE = 4,
    /* The airspeed is not within 0 to 1000 m/s, or the bank limit not within 0 to 90 degrees. */
    LOITER_BAD_AIRCRAFT = 5,
    /* The radius is not a positive, finite number. */
    LOITER_BAD_ORBIT = 6,
    /* The side is none of LOITER_CW, LOITER_CCW and LOITER_EITHER. */
    LOITER_BAD_TURN = 7,
    /* (c, s) of the problem is not a unit vector. */
    LOITER_BAD_POSE = 8,
    /* The wind is as fast as the aircraft, or faster. */
    LOITER_WIND_TOO_STRONG = 10,
    /* The circle is too tight for this wind: (airspeed + wind)^2 / (9.80665 * tan(bank limit)) exceeds its radius. */
    LOITER_NOT_HELD = 11,
    /* The search found no entry that ends on the circle. */
    LOITER_NOT_CONVERGED = 12,
    /* The wind is nan or infinite. */
    LOITER_BAD_WIND = 13,
    /* `dt_s` of a step is not above 0 and at most LOITER_LONGEST_STEP_S. */
    LOITER_BAD_STEP = 14,
    /* The roll response, delay, reserve, smoothing, gain or search_steps is negative or out of range. */
    LOITER_BAD_RESPONSE = 15,
    /* A search is not complete yet: continue it in the next cycle. */
    LOITER_SEARCHING = 16
};

/* The longest step, seconds: a command that lasted longer would say nothing, and one of 1e38 s overflows. */
#define LOITER_LONGEST_STEP_S 3600

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
typedef struct { loiter_real x, y, c, s, R, wx, wy, arc_tolerance; } loiter_WindScene;
typedef struct { loiter_real time; loiter_integer word; loiter_real t1, t2, t3, lam, p1, p2; } loiter_Path;
typedef struct { loiter_real phase; loiter_integer side; loiter_Path path; } loiter_WindCandidate;
typedef struct { loiter_integer side, word; loiter_real t1, t2, t3; } loiter_Entry;
typedef struct { loiter_Entry entry; loiter_real phase, miss; } loiter_EntryBeside;
typedef struct { loiter_integer number, level, words; } loiter_CellVisit;
typedef struct { loiter_real phase; loiter_Path path; loiter_real slope; } loiter_JoinPoint;
typedef struct { loiter_integer number; loiter_JoinPoint point; } loiter_LeafEnd;
typedef struct { loiter_integer first, second, third, fourth; } loiter_Leaves;
typedef struct { loiter_real phase; loiter_integer u; loiter_real t1, t2; } loiter_Corner;
typedef struct { loiter_integer stage, side; loiter_real width; loiter_JoinPoint here, other, last; loiter_integer
        words; bool bisect; loiter_integer steps, enclosures; } loiter_Refinement;
typedef struct { loiter_integer words; loiter_real earliest, tolerance; } loiter_OpenCell;
typedef struct { loiter_integer status, side, word; loiter_real t1, t2, t3, azimuth, miss; } loiter_WindEntry;
typedef struct { loiter_integer stage, sides, side; loiter_WindScene scene; loiter_WindCandidate best;
        loiter_EntryBeside beside; loiter_CellVisit visit; loiter_LeafEnd before; loiter_Leaves leaves, others;
        loiter_Corner corner; loiter_real compared; loiter_integer visits; loiter_Refinement refinement;
        loiter_OpenCell cell; loiter_integer left; loiter_WindEntry entry; } loiter_WindSearch;

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
typedef struct { loiter_real east_m, north_m, radius_m; loiter_integer side; loiter_real velocity_east_m_s,
        velocity_north_m_s, wind_east_m_s, wind_north_m_s, limit_deg, command_limit_deg, gain, reserve, smoothing_s,
        negligible_wind, covered_s; loiter_integer search_steps; } loiter_Settings;
typedef struct { loiter_real time_s, rate_deg_s, lag_s, slew_deg_s; } loiter_RollValues;
typedef struct { loiter_RollValues roll; loiter_real delay_s, turn_ratio, quick_turn_ratio, course_lead_s,
        wind_east_m_s, wind_north_m_s, airspeed_m_s, turn_airspeed_m_s, overshoot_deg, turns_unknown,
        heading_bias_deg, bank_bias_deg; } loiter_VehicleEstimates;
typedef struct { loiter_integer revision; loiter_real bank_deg, bank_rate_deg_s; loiter_VehicleEstimates estimates;
        } loiter_VehicleModel;
typedef struct { loiter_real time_s, since_s, gap_s, jump_s, first_s, latest_s; } loiter_Clock;
typedef struct { loiter_real time_s, square; } loiter_Difference;
typedef struct { loiter_real near_square, far_square, known_s; } loiter_AlongFlight;
typedef struct { loiter_real time_s, east_m_s, north_m_s, turn_rate; } loiter_AirSample;
typedef struct { loiter_AirSample at[64]; } loiter_AirSample_ring_64;
typedef struct { loiter_real east_m_s, north_m_s, known_s; loiter_Difference near, far; loiter_AlongFlight along;
        loiter_AirSample_ring_64 *recent; loiter_integer lag_index; } loiter_AirAverage;
typedef struct { loiter_real x, y, c, s; } loiter_PlanarPose;
typedef struct { loiter_real ratio, lead_s; } loiter_Turning;
typedef struct { loiter_real time_s; loiter_PlanarPose pose; loiter_real airspeed_m_s, turn_rate, bank_deg,
        air_east_m_s, air_north_m_s; loiter_Turning turning; } loiter_Estimate;
typedef struct { loiter_real smoothing_s, interval_s; loiter_AirAverage air; loiter_Estimate estimate; }
        loiter_Observer;
typedef struct { loiter_real end_s, bank_deg, integral; } loiter_BankEntry;
typedef struct { loiter_BankEntry at[128]; } loiter_BankEntry_ring_128;
typedef struct { loiter_BankEntry_ring_128 *entries; } loiter_BankHistory;
typedef struct { loiter_Clock clock; loiter_Observer observer; loiter_BankHistory history; loiter_real command_deg;
        loiter_Estimate present; loiter_real bank_rate_deg_s, elapsed_s, model_error_deg; bool is_known; }
        loiter_Sensing;
typedef struct { loiter_real airspeed_m_s, tightest_m, planned_m; } loiter_TurnLimits;
typedef struct { loiter_integer revision; bool wind_differs; loiter_real wind_east_m_s, wind_north_m_s;
        loiter_RollValues roll; loiter_real limit_deg; loiter_TurnLimits turns; loiter_real hold_deg; loiter_integer
        hold_half_deg, planned_half_deg; loiter_real lead_s, reversal_s2, reversal_m, lag_s; } loiter_Limits;
typedef struct { loiter_integer u; loiter_real x, y, c, s, end_x, end_y, time_s, radius_m; } loiter_RoutePiece;
typedef struct { loiter_integer side; loiter_RoutePiece current, second, third; loiter_real more_s; loiter_integer
        last_u; loiter_real start_s, turn_radius_m, speed_m_s, wind_east_m_s, wind_north_m_s; } loiter_Route;
typedef struct { loiter_Route route; loiter_real remaining_s, join_s, planned_join_s, searched_s; } loiter_Plan;
typedef struct { loiter_integer u; loiter_real time_s, radius_m; } loiter_PathPiece;
typedef struct { loiter_PathPiece at[12]; } loiter_PathPiece_ring_12;
typedef struct { loiter_PathPiece_ring_12 *pieces; loiter_integer total, taken; loiter_real c, s; }
        loiter_GivenPath;
typedef struct { loiter_integer bank, rate, command, current, next, last; loiter_real current_s, more, next_s,
        last_s, displaced_s2; } loiter_Leads;
typedef struct { loiter_real time_s, x, y, vx, vy, hx, hy; } loiter_RelativeState;
typedef struct { loiter_real crosstrack, course_error, path_rate; } loiter_PathOffset;
typedef struct { loiter_RelativeState state; loiter_PathOffset offset; loiter_real early_s; } loiter_ResponsePoint;
typedef struct { loiter_integer aim; loiter_RelativeState state; loiter_TurnLimits turns; loiter_real wind_east_m_s,
        wind_north_m_s, radius_m, wide_m; loiter_integer side; bool reversing, is_second, is_begun;
        loiter_WindSearch in_air; } loiter_EntrySearch;
typedef struct { loiter_Plan plan; loiter_GivenPath path; loiter_Leads leads; loiter_ResponsePoint response;
        loiter_EntrySearch search; bool has_joined; } loiter_Planning;
typedef struct { loiter_real turn_rate_deg_s, bank_deg; loiter_integer phase; loiter_real time_to_join_s;
        loiter_integer side, next_phase; loiter_real next_in_s; } loiter_LawCommand;
typedef struct { loiter_Sensing sensing; loiter_Limits limits; loiter_Planning planning; loiter_real trim;
        loiter_LawCommand command; loiter_real step_s; } loiter_Memory;
typedef struct { loiter_AirSample_ring_64 AirSample_ring_64; loiter_BankEntry_ring_128 BankEntry_ring_128; loiter_PathPiece_ring_12 PathPiece_ring_12; } loiter_Rings;

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
