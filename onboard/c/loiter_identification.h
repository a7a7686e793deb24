/* Identification of the vehicle in flight, for the law of loiter.h: docs/onboard.md. Without it this file and
 * loiter_identification.c are left out.
 *
 * Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
 *
 * SHA-256 of the source: 875b507c7117b08ac03bc4202585b8173c801cdbc58b758a94ae3d8669e97ce7
 */
#ifndef LOITER_IDENTIFICATION_H
#define LOITER_IDENTIFICATION_H

#include "loiter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The structures of which the state of an identification consists. No program needs to read them. */
typedef struct { loiter_real declared, at_index, step, spread, bias, variance; } loiter_Unknown;
typedef struct { loiter_real change, change_s, rate, rate_kept, lag_s; } loiter_ModelStep;
typedef struct { loiter_ModelStep at[8]; } loiter_ModelStep_ring_8;
typedef struct { loiter_real at[8]; } loiter_real_ring_8;
typedef struct { loiter_real at[6]; } loiter_real_ring_6;
typedef struct { loiter_real at[14]; } loiter_real_ring_14;
typedef struct { loiter_Unknown time, rate, delay; loiter_real slew_deg_s; loiter_ModelStep_ring_8 kinds;
        loiter_real_ring_8 kind_logs; loiter_real_ring_6 limits_deg; loiter_real_ring_6 rate_logs;
        loiter_real_ring_14 delay_logs; } loiter_RollSettings;
typedef struct { loiter_VehicleEstimates declared; loiter_real wind_known_s, limit_deg; loiter_RollSettings roll; }
        loiter_IdentificationSettings;
typedef struct { loiter_Clock clock; loiter_real waited_s, used_s; } loiter_Stamps;
typedef struct { loiter_real bank_deg, after_s, since_s; } loiter_MeasuredBank;
typedef struct { loiter_real total, weighted, squared; } loiter_Sums;
typedef struct { loiter_MeasuredBank measured; loiter_integer done; loiter_real errors, squares; loiter_Sums time,
        rate, delay; loiter_real lag_s, second; } loiter_Comparison;
typedef struct { loiter_real bank_deg, rate_deg_s; } loiter_Bank;
typedef struct { loiter_Bank present, earliest; } loiter_RollModel;
typedef struct { loiter_RollModel at[6]; } loiter_RollModel_ring_6;
typedef struct { loiter_RollModel_ring_6 at[8]; } loiter_RollModel_ring_6_ring_8;
typedef struct { loiter_real_ring_14 commands_deg; loiter_RollModel_ring_6_ring_8 kinds; } loiter_Models;
typedef struct { loiter_real_ring_14 at[6]; } loiter_real_ring_14_ring_6;
typedef struct { loiter_real_ring_14_ring_6 logs; loiter_real_ring_6 probabilities; } loiter_KindWeights;
typedef struct { loiter_KindWeights at[8]; } loiter_KindWeights_ring_8;
typedef struct { loiter_RollValues roll; loiter_real delay_s; } loiter_RollEstimate;
typedef struct { loiter_KindWeights_ring_8 kinds; loiter_real total, log_total, variance_deg2; loiter_RollEstimate
        estimate; } loiter_Weights;
typedef struct { loiter_real bank_deg, bank_rate_deg_s, waiting_s, commanded, since_s; loiter_MeasuredBank measured;
        loiter_Comparison comparison; loiter_Models models; loiter_Weights weights; } loiter_RollMemory;
typedef struct { loiter_real xx, xu, uu, xy, uy; } loiter_TurnSums;
typedef struct { loiter_real ratio, bank_bias_deg; loiter_TurnSums sums; loiter_real last_deg, last_rate,
        last_slope, measured_deg, computed_deg, of_bias_deg; } loiter_SlowTurns;
typedef struct { loiter_real product, square; } loiter_RatioFit;
typedef struct { loiter_real value, last; } loiter_HighPass;
typedef struct { loiter_real ratio; loiter_RatioFit fit; loiter_real last_deg, last_rate_deg_s, measured_deg,
        computed_deg; loiter_HighPass measured_mean, computed_mean; } loiter_QuickTurns;
typedef struct { loiter_real lead_s; loiter_RatioFit fit; loiter_HighPass angle, rate; } loiter_CourseLead;
typedef struct { loiter_SlowTurns slow; loiter_QuickTurns quick; loiter_CourseLead lead; } loiter_Turns;
typedef struct { loiter_real heading, airspeed; } loiter_AirErrors;
typedef struct { loiter_real east_m_s, north_m_s, right_east_m_s, right_north_m_s, right, along, square; }
        loiter_AirMeans;
typedef struct { loiter_real since_s, swift_east_m_s, swift_north_m_s, usual_square; } loiter_WindChange;
typedef struct { loiter_real east_m_s, north_m_s; loiter_AirErrors errors, expected; loiter_real known_s;
        loiter_AirMeans means; loiter_WindChange change; } loiter_WindFit;
typedef struct { loiter_real value, known_s; } loiter_Average;
typedef struct { loiter_Average always, in_turns; } loiter_Airspeeds;
typedef struct { loiter_real overshoot_deg; bool has_begun; } loiter_Overshoot;
typedef struct { loiter_Stamps stamps; loiter_RollMemory roll; loiter_Turns turns; loiter_WindFit wind;
        loiter_Airspeeds airspeeds; loiter_Overshoot overshoot; loiter_integer revision; loiter_VehicleEstimates
        estimates; } loiter_Identification;

/* The state of an identification; it contains no pointers, so that it may be copied and moved. */
typedef struct {
    loiter_IdentificationSettings settings;
    loiter_Identification memory;
    uint32_t begin_us;
} loiter_identification;

/* Begin, after `loiter_law_begin`, which has set what is declared. With `is_wind_known` the declared wind counts for some
 * time of measurements; without it the wind is taken from the first ones. */
void loiter_identification_begin(loiter_identification *identification, loiter_law *law, bool is_wind_known);

/* In place of `loiter_law_step`: the law for the vehicle as it is identified from commands and measurements, its roll
 * response, delay, turn rates, biases of heading and bank, wind and airspeed: `law->vehicle.estimates`. */
int loiter_law_step_identified(loiter_law *law, loiter_identification *identification,
                               const loiter_measurement *measurement, loiter_real dt_s, loiter_command *command);

#ifdef __cplusplus
}
#endif
#endif
