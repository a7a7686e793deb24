/* The flight onto the circle without anything of PX4: the law in steps, and whether the circle is held steadily.
 *
 * MIT licence, as all of loiter.
 */
#pragma once

#include <loiter.h>

/* How far an aircraft is outside its circle, metres, and the angle from the tangent to its track, degrees. */
struct CircleOffset {
    float outside_m;
    float course_error_deg;
};

/* Whether the circle is held steadily, as `loiter guide` decides it: within the band for STAY_S and a quarter of the
 * circle, and then at a quiet moment, which is waited for half a circle. */
class SteadyHold
{
public:
    void begin(float radius_m);
    void update(const loiter_measurement &measurement, int side, float dt_s);
    bool settled() const { return _settled; }
    const CircleOffset &offset() const { return _offset; }

private:
    void average(float bank_deg, float dt_s);
    bool is_quiet() const;

    float _radius_m{0.0f};
    CircleOffset _offset{}, _mean{};
    float _azimuth_deg{0.0f};
    float _held_s{0.0f}, _flown_deg{0.0f}, _waited_deg{0.0f};
    float _mean_bank_deg{0.0f}, _quiet_s{0.0f};
    bool _settled{false};
};

/* A law in flight. */
class EntryFlight
{
public:
    /* The status of loiter_law_begin: LOITER_OK, or the flight must not be used. */
    int begin(const loiter_law_config &config);

    /* The bank for the next `dt_s` seconds, degrees, positive to the right. */
    float step(const loiter_measurement &measurement, float dt_s);

    const loiter_command &command() const { return _command; }
    const SteadyHold &hold() const { return _hold; }

    /* Whether the position is more than 30 m, plus half of the distance flown, from where the last one leads. */
    bool jumps(const loiter_measurement &measurement) const;

private:
    loiter_law _law;
    loiter_command _command{};
    loiter_measurement _last{};
    SteadyHold _hold;
    bool _begun{false};
};
