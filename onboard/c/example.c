/* An aircraft at 18 m/s, 412 m west and 120 m north of the centre of a circle of 80 m, flies onto it: the fastest entry
 * as a plan, and then the law in a loop with a simple simulation in place of sensors and servos.
 *
 * cc -std=c99 -O2 -ffp-contract=off -DLOITER_FLOAT example.c loiter.c -lm && ./a.out
 */
#include "loiter.h"

#include <math.h>
#include <stdio.h>

#define AIRSPEED_M_S 18.0
#define BANK_LIMIT_DEG 35.0
#define RADIUS_M 80.0
#define GRAVITY_M_S2 9.80665
#define DEGREE 0.017453292519943295
#define STEP_S 0.02
#define DURATION_S 60

static const char *const NAMES[] = {"right", "straight", "left", "hold", "no data"};

static const char *name(int phase) { return NAMES[phase - LOITER_RIGHT]; }

/* The plan: lengths in turn radii, times in turn radii over airspeed. */
static void print_plan(double east_m, double north_m, double heading_deg) {
    const double radius = AIRSPEED_M_S * AIRSPEED_M_S / (GRAVITY_M_S2 * tan(BANK_LIMIT_DEG * DEGREE));
    loiter_problem problem = {0};
    loiter_entry entry;
    problem.x = (loiter_real)(east_m / radius);
    problem.y = (loiter_real)(north_m / radius);
    problem.c = (loiter_real)sin(heading_deg * DEGREE);
    problem.s = (loiter_real)cos(heading_deg * DEGREE);
    problem.radius = (loiter_real)(RADIUS_M / radius);
    problem.side = LOITER_EITHER;
    if (loiter_fastest(&problem, &entry) != LOITER_OK) {
        printf("there is no entry\n");
        return;
    }
    printf("plan:");
    for (int i = 0; i < entry.pieces; i++) {
        printf(" %s %.1f s,", name(entry.controls[i]), (double)entry.durations[i] * radius / AIRSPEED_M_S);
    }
    printf(" then %s\n", entry.side == LOITER_CW ? "clockwise" : "counter-clockwise");
}

int main(void) {
    double east_m = -412.0, north_m = 120.0, heading_deg = 90.0, bank_deg = 0.0;
    static loiter_law law;
    const loiter_law_config config =
        loiter_law_defaults((loiter_real)AIRSPEED_M_S, (loiter_real)BANK_LIMIT_DEG, (loiter_real)RADIUS_M, LOITER_EITHER);
    print_plan(east_m, north_m, heading_deg);
    if (loiter_law_begin(&law, &config) != LOITER_OK) {
        printf("the circle cannot be held\n");
        return 1;
    }
    for (int i = 0; i < (int)(DURATION_S / STEP_S); i++) {
        const double c = sin(heading_deg * DEGREE), s = cos(heading_deg * DEGREE);
        loiter_measurement measured;
        loiter_command command;
        measured.time_us = (uint32_t)(i * STEP_S * 1e6 + 0.5);
        measured.east_m = (loiter_real)east_m;
        measured.north_m = (loiter_real)north_m;
        measured.heading_deg = (loiter_real)heading_deg;
        measured.bank_deg = (loiter_real)bank_deg;
        measured.velocity_east_m_s = (loiter_real)(AIRSPEED_M_S * c);
        measured.velocity_north_m_s = (loiter_real)(AIRSPEED_M_S * s);
        measured.airspeed_m_s = (loiter_real)AIRSPEED_M_S;
        if (loiter_law_step(&law, &measured, (loiter_real)STEP_S, &command) != LOITER_OK) {
            return 1;
        }
        if (i % 250 == 0) {
            printf("%4.0f s: %7.1f m from the circle, %-8s bank %5.1f deg, on the circle in %4.1f s\n", i * STEP_S,
                   sqrt(east_m * east_m + north_m * north_m) - RADIUS_M, name(command.phase), (double)command.bank_deg,
                   (double)command.time_to_join_s);
        }
        /* The autopilot holds the commanded bank with a lag of half a second; the aircraft turns as its bank says. */
        bank_deg += ((double)command.bank_deg - bank_deg) * STEP_S / 0.5;
        heading_deg += GRAVITY_M_S2 * tan(bank_deg * DEGREE) / AIRSPEED_M_S * STEP_S / DEGREE;
        east_m += AIRSPEED_M_S * c * STEP_S;
        north_m += AIRSPEED_M_S * s * STEP_S;
    }
    return 0;
}
