/* What the module of onboard/px4 needs of PX4: its names, and the fields that it uses. Topics hold their last message.
 *
 * The names are those of PX4's interfaces; the code is ours. The test puts a header of each name that the module includes
 * beside this one.
 */
#pragma once

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define PX4_ISFINITE(x) (isfinite(x) != 0)
#define PX4_INFO(...) (printf(__VA_ARGS__), printf("\n"))
#define PX4_ERR(...) (printf(__VA_ARGS__), printf("\n"))
#define mavlink_log_info(publication, ...) (*(publication) = nullptr, printf(__VA_ARGS__), printf("\n"))
#define __EXPORT

typedef void *orb_advert_t;
typedef uint64_t hrt_abstime;
typedef int param_t;

hrt_abstime hrt_absolute_time();
inline hrt_abstime hrt_elapsed_time(const hrt_abstime *then) { return hrt_absolute_time() - *then; }
param_t param_find(const char *name);
int param_get(param_t parameter, void *value);
void px4_usleep(uint32_t us);

namespace px4
{
struct wq_config_t {
    const char *name;
    uint16_t stacksize;
    int8_t relative_priority;
};

class WorkItem
{
public:
    WorkItem() = default;
    virtual ~WorkItem();
    virtual void Run() = 0;
    void ScheduleNow() { due = hrt_absolute_time(); }
    hrt_abstime due{UINT64_MAX};
};

class ScheduledWorkItem : public WorkItem
{
public:
    ScheduledWorkItem(const char *name, const wq_config_t &queue);
    void ScheduleDelayed(uint32_t us) { due = hrt_absolute_time() + us; }
    void ScheduleClear() { due = UINT64_MAX; }
};
}

template<class T> struct Topic {
    T message;
    unsigned published;
};

template<class T> Topic<T> &topic()
{
    static Topic<T> one{};
    return one;
}

/* The item that runs with each new position. */
extern px4::WorkItem *listener;

#define ORB_ID(name) (&topic<name##_s>())

namespace uORB
{
class Subscription
{
public:
    template<class T> explicit Subscription(Topic<T> *) {}

    template<class T> bool update(T *to)
    {
        const bool is_new = topic<T>().published != _seen;
        _seen = topic<T>().published;

        if (is_new) {
            *to = topic<T>().message;
        }

        return is_new;
    }

private:
    unsigned _seen{0};
};

class SubscriptionCallbackWorkItem : public Subscription
{
public:
    template<class T> SubscriptionCallbackWorkItem(px4::WorkItem *item, Topic<T> *of) : Subscription(of), _item(item) {}
    bool registerCallback() { listener = _item; return true; }
    void unregisterCallback() { listener = nullptr; }

private:
    px4::WorkItem *_item;
};

template<class T> class Publication
{
public:
    explicit Publication(Topic<T> *) {}
    void publish(const T &message) { topic<T>().message = message; topic<T>().published++; }
};
}

struct airspeed_validated_s { uint64_t timestamp; float calibrated_airspeed_m_s, true_airspeed_m_s; };
struct arming_check_request_s { uint8_t request_id; };
struct arming_check_reply_s {
    static constexpr uint8_t HEALTH_COMPONENT_INDEX_NONE = 0;
    uint64_t timestamp;
    uint8_t request_id, registration_id, health_component_index;
    bool can_arm_and_run, mode_req_angular_velocity, mode_req_attitude, mode_req_local_alt, mode_req_local_position;
    bool mode_req_global_position, mode_req_prevent_arming;
};
struct fixed_wing_lateral_setpoint_s { uint64_t timestamp; float course, airspeed_direction, lateral_acceleration; };
struct fixed_wing_longitudinal_setpoint_s {
    uint64_t timestamp;
    float altitude, height_rate, equivalent_airspeed, pitch_direct, throttle_direct;
};
struct parameter_update_s { uint64_t timestamp; };
struct register_ext_component_request_s {
    static constexpr uint16_t LATEST_PX4_ROS2_API_VERSION = 2;
    uint64_t timestamp, request_id;
    char name[25];
    uint16_t px4_ros2_api_version;
    bool register_arming_check, register_mode;
};
struct register_ext_component_reply_s { uint64_t request_id; bool success; int8_t arming_check_id, mode_id; };
struct setpoint_config_s {
    static constexpr uint16_t TYPE_FIXEDWING_LATERAL_LONGITUDINAL = 3;
    uint64_t timestamp;
    uint16_t type;
    uint8_t source_id;
    bool should_apply;
};
struct unregister_ext_component_s { uint64_t timestamp; char name[25]; int8_t arming_check_id, mode_id, mode_executor_id; };
struct vehicle_attitude_s { uint64_t timestamp; float q[4]; };
struct vehicle_command_s {
    static constexpr uint16_t VEHICLE_CMD_DO_ORBIT = 34;
    static constexpr uint8_t ORBIT_YAW_BEHAVIOUR_UNCHANGED = 5;
    uint64_t timestamp;
    float param1, param2, param3, param4;
    double param5, param6;
    float param7;
    uint32_t command;
    uint8_t target_system, target_component, source_system;
    uint16_t source_component;
};
struct vehicle_global_position_s { uint64_t timestamp, timestamp_sample; double lat, lon; bool lat_lon_valid; };
struct vehicle_local_position_s { uint64_t timestamp; float z, vx, vy, ref_alt; bool v_xy_valid; };
struct vehicle_status_s {
    static constexpr uint8_t NAVIGATION_STATE_POSCTL = 2, NAVIGATION_STATE_AUTO_LOITER = 4;
    static constexpr uint8_t NAVIGATION_STATE_EXTERNAL1 = 23, ARMING_STATE_DISARMED = 1, ARMING_STATE_ARMED = 2;
    uint8_t arming_state, nav_state, system_id, component_id;
};
struct wind_s { float windspeed_north, windspeed_east; };
