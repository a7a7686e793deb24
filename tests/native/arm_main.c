/* Runs on a Cortex-M without an operating system: entries and a flight of the law, printed with all their digits, and
 * the instructions that they took. Built for the host, it prints the same lines but those.
 */
#include "loiter_identification.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Instructions: QEMU takes one for a nanosecond, and the timer counts down 25 million times in a second. */
#ifdef __arm__
static unsigned long now(void) { return *(volatile unsigned long *)0xE000E018u; }
#else
static unsigned long now(void) { return 0; }
#endif
#define INSTRUCTIONS_A_TICK 40u

typedef struct {
    unsigned long count, sum, most;
} Counts;

static void counted(Counts *counts, unsigned long begin) {
    const unsigned long taken = ((begin - now()) & 0xFFFFFFul) * INSTRUCTIONS_A_TICK;
    counts->count++;
    counts->sum += taken;
    counts->most = taken > counts->most ? taken : counts->most;
}

static void print_counts(const char *name, const Counts *counts) {
    printf("instructions %s %lu %lu\n", name, counts->sum / counts->count, counts->most);
}

static unsigned state = 12345;

static loiter_real uniform(void) {
    state = state * 1664525u + 1013904223u;
    return (loiter_real)(state >> 8) / (loiter_real)16777216.0f;
}

static void print_bits(loiter_real value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    printf(" %08lx", (unsigned long)bits);
}

static void entries(int count, int windy) {
    Counts counts = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        loiter_problem p;
        loiter_entry entry;
        p.x = 12.0f * uniform() - 6.0f;
        p.y = 12.0f * uniform() - 6.0f;
        p.c = 2.0f * uniform() - 1.0f;
        p.s = sqrtf(1.0f - p.c * p.c);
        p.radius = 2.0f + 3.0f * uniform();
        p.side = (int)(3.0f * uniform()) - 1;
        p.wx = windy ? 0.5f * uniform() - 0.25f : 0.0f;
        p.wy = windy ? 0.5f * uniform() - 0.25f : 0.0f;
        p.tolerance = 0.001f;
        const unsigned long begin = now();
        const int status = loiter_fastest(&p, &entry);
        counted(&counts, begin);
        printf("%d", status);
        for (int k = 0; status == 0 && k < entry.pieces; k++) {
            printf(" %d", entry.controls[k]);
            print_bits(entry.durations[k]);
        }
        printf("\n");
    }
    print_counts(windy ? "wind" : "still", &counts);
}

/* A flight with bank and turn as commanded. */
static void flight(const char *name, int steps, loiter_real wind_east_m_s, int search_steps, int is_identified) {
    static loiter_law law;
    static loiter_identification known;
    Counts counts = {0, 0, 0};
    loiter_law_config config = loiter_law_defaults(18.0f, 35.0f, 90.0f, LOITER_EITHER);
    loiter_real x = -250.0f, y = 70.0f, heading_deg = 70.0f, bank_deg = 0.0f;
    config.wind_east_m_s = wind_east_m_s;
    config.search_steps = search_steps;
    printf("%d\n", loiter_law_begin(&law, &config));
    if (is_identified) {
        loiter_identification_begin(&known, &law, 0);
    }
    for (int i = 0; i < steps; i++) {
        const loiter_real c = sinf(heading_deg * 0.0174532925f), s = cosf(heading_deg * 0.0174532925f);
        const loiter_measurement m = {(uint32_t)i * 20000u,         x,        y, heading_deg, bank_deg,
                                      18.0f * c + wind_east_m_s, 18.0f * s, 18.0f};
        loiter_command command;
        const unsigned long begin = now();
        if (is_identified) {
            loiter_law_step_identified(&law, &known, &m, 0.02f, &command);
        } else {
            loiter_law_step(&law, &m, 0.02f, &command);
        }
        counted(&counts, begin);
        if (i % 50 == 0) {
            printf("%d", command.phase);
            print_bits(command.bank_deg);
            print_bits(command.time_to_join_s);
            printf("\n");
        }
        bank_deg += (command.bank_deg - bank_deg) * 0.04f;
        heading_deg += 9.80665f * tanf(bank_deg * 0.0174532925f) / 18.0f * 0.02f / 0.0174532925f;
        x += (18.0f * c + wind_east_m_s) * 0.02f;
        y += 18.0f * s * 0.02f;
    }
    print_counts(name, &counts);
}

int main(void) {
    flight("law", FLIGHT_STEPS, 0.0f, 0, 0);
    flight("law in wind", FLIGHT_STEPS, 4.0f, 0, 0);
    flight("law in wind by parts", FLIGHT_STEPS, 4.0f, 5, 0);
    flight("identified law", FLIGHT_STEPS, 0.0f, 0, 1);
    flight("identified law in wind by parts", FLIGHT_STEPS, 4.0f, 5, 1);
    entries(STILL_ENTRIES, 0);
    entries(WINDY_ENTRIES, 1);
    return 0;
}
