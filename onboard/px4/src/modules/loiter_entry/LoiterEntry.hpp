/* A flight mode of PX4 in which a fixed wing joins a holding circle in least time: docs/px4.md.
 *
 * MIT licence, as all of loiter.
 */
#pragma once

#include "EntryFlight.hpp"

#include <drivers/drv_hrt.h>
#include <parameters/param.h>
#include <px4_platform_common/px4_work_queue/ScheduledWorkItem.hpp>
#include <uORB/Publication.hpp>
#include <uORB/Subscription.hpp>
#include <uORB/SubscriptionCallback.hpp>
#include <uORB/topics/airspeed_validated.h>
#include <uORB/topics/arming_check_reply.h>
#include <uORB/topics/arming_check_request.h>
#include <uORB/topics/fixed_wing_lateral_setpoint.h>
#include <uORB/topics/fixed_wing_longitudinal_setpoint.h>
#include <uORB/topics/parameter_update.h>
#include <uORB/topics/register_ext_component_reply.h>
#include <uORB/topics/register_ext_component_request.h>
#include <uORB/topics/unregister_ext_component.h>
#include <uORB/topics/vehicle_attitude.h>
#include <uORB/topics/vehicle_command.h>
#include <uORB/topics/vehicle_global_position.h>
#include <uORB/topics/vehicle_local_position.h>
#include <uORB/topics/vehicle_status.h>
#include <uORB/topics/wind.h>

/* Before this topic came PX4 controlled everything that a mode needs unless it was told otherwise. */
#if __has_include(<uORB/topics/setpoint_config.h>)
#include <uORB/topics/setpoint_config.h>
#define LOITER_ENTRY_CONFIGURES_SETPOINTS
#endif

/* The circle: its centre, degrees and degrees, radius, metres, and LOITER_CW, LOITER_CCW or LOITER_EITHER. */
struct Circle {
    double latitude_deg, longitude_deg;
    float radius_m;
    int side;
};

class LoiterEntry : public px4::ScheduledWorkItem
{
public:
    LoiterEntry();

    bool init();

    /* Leave the mode and end: `has_ended` says when the object may be deleted. */
    void request_stop() { _should_stop = true; ScheduleNow(); }
    bool has_ended() const { return _has_ended; }
    void print_status() const;

private:
    void Run() override;
    void stop();

    /* Registration as a mode, and PX4's question several times a second whether the mode can run. */
    void register_mode();
    void take_registration();
    void answer_arming_check();

    void read_parameters();
    loiter_law_config law_config() const;
    float read(param_t parameter) const;

    void update_mode();
    void begin();
    void fly();
    bool measure(loiter_measurement &measurement);
    float true_airspeed_m_s() const;
    void report_progress();
    void publish_bank(float bank_deg);
    void configure_setpoints();

    /* Let PX4's Hold fly the circle from now on: asked for once a second until the mode has changed. */
    void hand_over(const char *reason);
    void command_orbit();

    uORB::SubscriptionCallbackWorkItem _position_sub{this, ORB_ID(vehicle_global_position)};
    uORB::Subscription _local_position_sub{ORB_ID(vehicle_local_position)};
    uORB::Subscription _attitude_sub{ORB_ID(vehicle_attitude)};
    uORB::Subscription _airspeed_sub{ORB_ID(airspeed_validated)};
    uORB::Subscription _wind_sub{ORB_ID(wind)};
    uORB::Subscription _status_sub{ORB_ID(vehicle_status)};
    uORB::Subscription _parameter_update_sub{ORB_ID(parameter_update)};
    uORB::Subscription _registered_sub{ORB_ID(register_ext_component_reply)};
    uORB::Subscription _arming_check_sub{ORB_ID(arming_check_request)};

    uORB::Publication<register_ext_component_request_s> _register_pub{ORB_ID(register_ext_component_request)};
    uORB::Publication<unregister_ext_component_s> _unregister_pub{ORB_ID(unregister_ext_component)};
    uORB::Publication<arming_check_reply_s> _arming_check_pub{ORB_ID(arming_check_reply)};
    uORB::Publication<fixed_wing_lateral_setpoint_s> _lateral_pub{ORB_ID(fixed_wing_lateral_setpoint)};
    uORB::Publication<fixed_wing_longitudinal_setpoint_s> _longitudinal_pub{ORB_ID(fixed_wing_longitudinal_setpoint)};
    uORB::Publication<vehicle_command_s> _command_pub{ORB_ID(vehicle_command)};
#ifdef LOITER_ENTRY_CONFIGURES_SETPOINTS
    uORB::Publication<setpoint_config_s> _setpoint_config_pub {ORB_ID(setpoint_config)};
#endif

    const param_t _latitude_param, _longitude_param, _radius_param, _direction_param;
    const param_t _roll_time_param, _roll_rate_param, _delay_param, _airspeed_param, _bank_param, _slew_param;

    vehicle_status_s _status{};
    vehicle_local_position_s _local{};
    vehicle_global_position_s _position{};
    vehicle_attitude_s _attitude{};
    airspeed_validated_s _airspeed{};
    wind_s _wind{};

    uint64_t _request_id{0};
    hrt_abstime _requested_at{0};
    int _mode{-1}, _arming_check{-1};

    Circle _circle{};
    int _circle_status{LOITER_BAD_ORBIT};
    EntryFlight _flight{};
    bool _flies{false}, _said_on_circle{false};
    float _airspeed_m_s{NAN}, _altitude_m{NAN};
    hrt_abstime _stepped_at{0}, _ordered_at{0}, _said_at{0};
    const char *_reason{nullptr};

    orb_advert_t _mavlink_log_pub{nullptr};
    volatile bool _should_stop{false}, _has_ended{false};
};
