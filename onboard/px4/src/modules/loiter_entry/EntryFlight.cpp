#include "EntryFlight.hpp"

#include <math.h>

static constexpr float DEGREES{57.29577951f};

/* The band around the circle that counts as on it: a share of the radius, and degrees of the course. */
static constexpr float BAND{0.05f}, BAND_DEG{5.0f};

/* How long, seconds, and how far, degrees around the circle, the aircraft must stay in the band. */
static constexpr float STAY_S{8.0f}, STAY_DEG{90.0f};

/* A quiet moment: averages over MEAN_S are within this share of the band, and the bank has been within QUIET_BANK_DEG of
 * its mean for QUIET_S. It is waited for no longer than LONGEST_WAIT_DEG of the circle. */
static constexpr float QUIET{0.3f}, MEAN_S{1.0f}, QUIET_S{2.0f}, QUIET_BANK_DEG{1.5f}, LONGEST_WAIT_DEG{180.0f};

static constexpr float JUMP_M{30.0f};

static float wrapped_deg(float angle_deg) { return remainderf(angle_deg, 360.0f); }

static CircleOffset circle_offset(const loiter_measurement &m, float radius_m, int side)
{
    const float distance_m = fmaxf(hypotf(m.east_m, m.north_m), 0.1f);
    const float out_east = m.east_m / distance_m, out_north = m.north_m / distance_m;
    const float outward = m.velocity_east_m_s * out_east + m.velocity_north_m_s * out_north;
    const float clockwise = m.velocity_east_m_s * out_north - m.velocity_north_m_s * out_east;
    const float direction = side < 0 ? -1.0f : 1.0f;
    return {distance_m - radius_m, DEGREES * atan2f(-direction * outward, direction * clockwise)};
}

void SteadyHold::begin(float radius_m)
{
    *this = SteadyHold{};
    _radius_m = radius_m;
}

void SteadyHold::update(const loiter_measurement &measurement, int side, float dt_s)
{
    const float azimuth_deg = DEGREES * atan2f(measurement.east_m, measurement.north_m);
    const float turned_deg = fabsf(wrapped_deg(azimuth_deg - _azimuth_deg));
    _azimuth_deg = azimuth_deg;
    _offset = circle_offset(measurement, _radius_m, side);
    average(measurement.bank_deg, dt_s);

    if (side == 0 || !(fabsf(_offset.outside_m) <= BAND * _radius_m) || !(fabsf(_offset.course_error_deg) <= BAND_DEG)) {
        _held_s = _flown_deg = _waited_deg = 0.0f;
        _settled = false;
        return;
    }

    _held_s += dt_s;
    _flown_deg += turned_deg;

    if (_held_s >= STAY_S && _flown_deg >= STAY_DEG) {
        _waited_deg += turned_deg;
        _settled = is_quiet() || _waited_deg >= LONGEST_WAIT_DEG;
    }
}

void SteadyHold::average(float bank_deg, float dt_s)
{
    const float share = 1.0f - expf(-dt_s / MEAN_S);
    _mean.outside_m += share * (_offset.outside_m - _mean.outside_m);
    _mean.course_error_deg += share * (_offset.course_error_deg - _mean.course_error_deg);
    _mean_bank_deg += share * (bank_deg - _mean_bank_deg);
    _quiet_s = fabsf(bank_deg - _mean_bank_deg) <= QUIET_BANK_DEG ? _quiet_s + dt_s : 0.0f;
}

bool SteadyHold::is_quiet() const
{
    return fabsf(_mean.outside_m) <= QUIET * BAND * _radius_m && fabsf(_mean.course_error_deg) <= QUIET * BAND_DEG
           && _quiet_s >= QUIET_S;
}

int EntryFlight::begin(const loiter_law_config &config)
{
    _begun = false;
    _command = {};
    _hold.begin(config.radius_m);
    return loiter_law_begin(&_law, &config);
}

float EntryFlight::step(const loiter_measurement &measurement, float dt_s)
{
    if (loiter_law_step(&_law, &measurement, dt_s, &_command) == LOITER_OK) {
        _hold.update(measurement, _command.side, dt_s);
        _last = measurement;
        _begun = true;
    }

    return _command.bank_deg;
}

bool EntryFlight::jumps(const loiter_measurement &measurement) const
{
    if (!_begun) {
        return false;
    }

    const float dt_s = 1e-6f * (float)(measurement.time_us - _last.time_us);
    const float east_m = measurement.east_m - _last.east_m - dt_s * _last.velocity_east_m_s;
    const float north_m = measurement.north_m - _last.north_m - dt_s * _last.velocity_north_m_s;
    const float flown_m = dt_s * hypotf(_last.velocity_east_m_s, _last.velocity_north_m_s);
    return hypotf(east_m, north_m) > JUMP_M + 0.5f * flown_m;
}
