@HEAD@
#ifndef LOITER_IDENTIFICATION_H
#define LOITER_IDENTIFICATION_H

#include "loiter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The structures of which the state of an identification consists. No program needs to read them. */
@STRUCTURES@

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
