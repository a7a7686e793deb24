/* Runs on a Cortex-M without an operating system: entries and a flight of the law, printed with all their digits, and
 * the instructions that they took. Built for the host, it prints the same lines but those.
 */
#include "loiter.h"

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
static void flight(int steps, loiter_real wind_east_m_s, int search_steps) {
    static loiter_law law;
    Counts counts = {0, 0, 0};
    loiter_law_config config = loiter_law_defaults(18.0f, 35.0f, 90.0f, LOITER_EITHER);
    loiter_real x = -250.0f, y = 70.0f, heading_deg = 70.0f, bank_deg = 0.0f;
    config.wind_east_m_s = wind_east_m_s;
    config.search_steps = search_steps;
    printf("%d\n", loiter_law_begin(&law, &config));
    for (int i = 0; i < steps; i++) {
        const loiter_real c = sinf(heading_deg * 0.0174532925f), s = cosf(heading_deg * 0.0174532925f);
        const loiter_measurement m = {(uint32_t)i * 20000u,         x,        y, heading_deg, bank_deg,
                                      18.0f * c + wind_east_m_s, 18.0f * s, 18.0f};
        loiter_command command;
        const unsigned long begin = now();
        loiter_law_step(&law, &m, 0.02f, &command);
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
    print_counts(search_steps > 0 ? "law in wind by parts" : wind_east_m_s != 0.0f ? "law in wind" : "law", &counts);
}

int main(void) {
    flight(FLIGHT_STEPS, 0.0f, 0);
    flight(FLIGHT_STEPS, 4.0f, 0);
    flight(FLIGHT_STEPS, 4.0f, 5);
    entries(STILL_ENTRIES, 0);
    entries(WINDY_ENTRIES, 1);
    return 0;
}
