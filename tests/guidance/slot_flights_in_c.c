/* Flights into a slot: `SlotEntry` with the vehicle of flights_in_c.c, for a number of steps. */

#include "flights_in_c.c"

typedef struct {
    double east_m, north_m;
} Place;

/* Fly `steps` steps; `places` has room for the place after each. */
void fly_into_slot(const Scene *s, const Settings *settings, const SlotSettings *slot, const VehicleEstimates *declared,
                   double wind_known_s, const double *normals, const double *gusts, int64_t steps, Place *places) {
    static Mass mass;
    static Memory memory;
    static Identification identification;
    const IdentificationSettings known = settings_of(*declared, settings->limit_deg, wind_known_s);
    begin_mass(&mass, s, normals, gusts);
    memset(&identification, 0, sizeof identification);
    begin_identification(&identification, &known);
    memory = first_memory(*settings, (VehicleModel){0, 0.0, 0.0, *declared});
    SlotMemory kept = first_slot_memory(*slot);
    for (int64_t i = 0; i < steps; i++) {
        advance_identification(&identification, &known, mass.latest, memory.command.bank_deg, memory.step_s);
        const VehicleModel vehicle = {
            identification.revision, identification.roll.bank_deg, identification.roll.bank_rate_deg_s,
            identification.estimates};
        const Memory_SlotMemory after =
            advance_in_slot(memory, kept, *settings, *slot, vehicle, mass.latest, s->step_s);
        memory = after.a0;
        kept = after.a1;
        advance_mass(&mass, memory.command.bank_deg, s->step_s);
        places[i] = (Place){mass.pose.x, mass.pose.y};
    }
}

/* The law of formation.py, with its gains; phases along the hold, radians. */
static const double K_E = 1.0, K_N = 1.0, K_RADIUS = 1.0 / 8.0, GRAVITY = 9.80665, WHOLE_TURN = 6.283185307179586;

static double formation_radius(const double *phases, int64_t i, int64_t n, double orbit_m) {
    const double ahead = remainder(phases[(i + 1) % n] - phases[i] - WHOLE_TURN / n, WHOLE_TURN);
    const double behind = remainder(phases[i] - phases[(i + n - 1) % n] - WHOLE_TURN / n, WHOLE_TURN);
    return orbit_m + K_RADIUS * orbit_m * (behind - ahead);
}

static double field(double east, double north, double side, double r) {
    const double excess = (east * east + north * north) / (r * r) - 1.0;
    return atan2(-side * east - K_E * excess * north, side * north - K_E * excess * east);
}

static double formation_bank(State state, double side, double r, double limit_deg) {
    const double x = state.east_m, y = state.north_m, vx = state.velocity_east_m_s, vy = state.velocity_north_m_s;
    const double h = 1e-4;
    const double after = field(x + h * vx, y + h * vy, side, r), before = field(x - h * vx, y - h * vy, side, r);
    const double off = remainder(field(x, y, side, r) - atan2(vy, vx), WHOLE_TURN);
    const double drawn = fabs(off) < 0.25 * WHOLE_TURN ? sin(off) : off > 0.0 ? 1.0 : -1.0;
    const double rate = remainder(after - before, WHOLE_TURN) / (2.0 * h) + K_N * drawn;
    return clip(DEGREE * atan(-rate * sqrt(vx * vx + vy * vy) / GRAVITY), limit_deg);
}

#define MOST_AIRCRAFT 16

/* Fly `n` aircraft, at most MOST_AIRCRAFT, by that law; each has `normals_each` and `gusts_each` random numbers.

   No radius is below `least_m`. `places` has room for the places of all after each step. */
void fly_formation(const Scene *scenes, int64_t n, double side, double orbit_m, double least_m, const double *normals,
                   int64_t normals_each, const double *gusts, int64_t gusts_each, int64_t steps, Place *places) {
    static Mass flown[MOST_AIRCRAFT];
    for (int64_t i = 0; i < n; i++) {
        begin_mass(&flown[i], &scenes[i], normals + i * normals_each, gusts + i * gusts_each);
    }
    for (int64_t step = 0; step < steps; step++) {
        double phases[MOST_AIRCRAFT];
        for (int64_t i = 0; i < n; i++) {
            phases[i] = -side * atan2(flown[i].latest.north_m, flown[i].latest.east_m);
        }
        for (int64_t i = 0; i < n; i++) {
            const double wanted_m = formation_radius(phases, i, n, orbit_m);
            const double r = wanted_m > least_m ? wanted_m : least_m;
            const double bank_deg = formation_bank(flown[i].latest, side, r, scenes[i].limit_deg);
            advance_mass(&flown[i], bank_deg, scenes[i].step_s);
            places[step * n + i] = (Place){flown[i].pose.x, flown[i].pose.y};
        }
    }
}
