// @ts-check

/**
 * Scenes, and the answers of the library to them. Lengths are in metres, times in seconds, headings in compass degrees.
 *
 * @typedef {{east_m: number, north_m: number, heading_deg: number}} Pose
 * @typedef {"cw" | "ccw"} Direction  of the hold, seen from above
 * @typedef {"either" | Direction} Turn
 * @typedef {object} Orbit
 * @property {number} east_m
 * @property {number} north_m
 * @property {number} radius_m
 * @property {Turn} turn
 * @property {number} velocity_east_m_s
 * @property {number} velocity_north_m_s
 *
 * @typedef {"max_bank_deg" | "min_turn_radius_m" | "max_turn_rate_deg_s"} Limit
 * @typedef {{airspeed_m_s: number} & Partial<Record<Limit, number>>} Aircraft  with exactly one limit
 * @typedef {{speed_m_s: number, from_deg: number}} Wind
 * @typedef {{latitude_deg: number, longitude_deg: number}} Origin
 *
 * @typedef {object} Scene  the body of a request; a change makes a new one
 * @property {Pose} pose
 * @property {Orbit} orbit
 * @property {Aircraft} aircraft
 * @property {Wind | null} wind
 * @property {number} tolerance_m
 * @property {Origin | null} origin
 * @property {Fence | null} fence
 * @property {Slot | null} slot
 * @property {Leg | null} leg
 *
 * @typedef {{phase_deg: number, at_s: number}} Slot  a place on the circle that moves with the hold: its bearing from the
 *   centre at a time
 *
 * @typedef {{name: string, east_m: number, north_m: number, radius_m: number, inclusion: boolean}} CircleZone
 * @typedef {{name: string, corners: [number, number][], inclusion: boolean}} PolygonZone  east and north of its corners
 * @typedef {CircleZone | PolygonZone} Zone  to stay inside (`inclusion`) or outside
 * @typedef {{zones: Zone[], margin_m: number | null}} Fence  with the library's own margin where that is null
 *
 * @typedef {object} Breach  a zone that is entered, or to which the path comes closer than the margin
 * @property {string} zone
 * @property {boolean} enters
 * @property {boolean} holding
 * @property {number} clearance_m
 * @property {number} time_s
 * @property {number} east_m
 * @property {number} north_m
 *
 * @typedef {{clear: boolean, margin_m: number, closest: Breach, breaches: Breach[], sentence: string}} FenceCheck
 *
 * @typedef {object} ClearEntry  the fastest clear entry that is found
 * @property {string} sentence
 * @property {number | null} later_s
 * @property {number | null} least_s  no clear entry takes less; null where there is none
 * @property {string[]} blocking
 * @property {string | null} instruction
 * @property {Track | null} lap
 * @property {Maneuver | null} maneuver
 *
 * @typedef {object} Leg  what is flown after the entry; null is not given
 * @property {[number, number]} exit_to  the point flown to, east and north
 * @property {number} hold_s  least time on the circle
 * @property {number} turns  least number of turns
 * @property {number | null} start_altitude_m  above mean sea level
 * @property {number | null} altitude_m  at the exit
 * @property {number | null} climb_rate_m_s
 * @property {number | null} descent_rate_m_s
 *
 * @typedef {object} LegPlan  the way in, round and out
 * @property {number} duration_s  the time at the point
 * @property {Direction} turn
 * @property {number} join_s
 * @property {number} held_s
 * @property {number} held_deg
 * @property {number} exit_s
 * @property {Pose} exit
 * @property {string} sentence
 * @property {string} instruction
 * @property {string} command
 * @property {string} python
 * @property {{time_s: number[], altitude_m: number[]} | null} altitudes
 * @property {Maneuver} maneuver  the whole leg, with its track
 *
 * @typedef {"msl" | "home" | "ground"} Reference  the level from which an altitude is measured
 * @typedef {object} Altitude  the altitude of missions, as far as the user has given it; metres
 * @property {number} [altitude_m]
 * @property {Reference} [altitude_reference]
 * @property {number} [home_altitude_m]  altitude of home above mean sea level
 *
 * @typedef {object} Track  samples of a maneuver; x and y are the reduced state in turn radii
 * @property {number[]} time_s
 * @property {number[]} east_m
 * @property {number[]} north_m
 * @property {number[]} heading_deg
 * @property {number[]} x
 * @property {number[]} y
 *
 * @typedef {"L" | "S" | "R"} Letter
 * @typedef {object} Segment
 * @property {Letter} letter
 * @property {"hold" | "leave"} [name]  of the parts of a leg after its entry
 * @property {number} start_s
 * @property {number} duration_s
 * @property {Pose} start
 * @property {Pose} end
 *
 * @typedef {object} Maneuver
 * @property {number} duration_s
 * @property {number} [join_s]  of a leg, whose duration is that to its point
 * @property {number} length_m
 * @property {string} word
 * @property {Direction} turn
 * @property {Pose} join
 * @property {{centre_east_m: number, centre_north_m: number}} join_over_ground
 * @property {Wind} wind
 * @property {{least_bank_deg: number, largest_bank_deg: number}} hold
 * @property {Segment[]} segments
 * @property {{airspeed_m_s: number, turn_radius_m: number}} aircraft
 * @property {Track} track
 *
 * @typedef {Maneuver & {later_s: number}} Alternative
 *
 * @typedef {object} Extra
 * @property {Alternative[]} alternatives  the other optimal maneuvers, then the slower ones
 * @property {number} optimal  number of optimal maneuvers
 * @property {number | null} other_turn_later_s
 * @property {string} instruction
 * @property {string} command
 * @property {string} python
 * @property {{x: number, y: number, radius: number}} reduced
 *
 * @typedef {Maneuver & Extra} Answer
 *
 * @typedef {object} Series
 * @property {number[]} time_s
 * @property {number[]} u
 * @property {number[]} phi
 * @property {number[]} psi1
 * @property {number[]} psi2
 * @property {number[]} switches_s
 *
 * @typedef {object} Certificate
 * @property {boolean} valid
 * @property {boolean} proved_optimal
 * @property {string} basis
 * @property {number | null} lambda
 * @property {string | null} runner_up
 * @property {number | null} margin_s
 * @property {{name: string, verdict: "holds" | "FAILED" | "skipped"}[]} residuals
 *
 * @typedef {{certificate: Certificate, series: Series}} Proof
 *
 * @typedef {{kind: string, words?: string[], x: (number | null)[], y: (number | null)[]}} Curve
 * @typedef {object} Synthesis
 * @property {number} radius
 * @property {Turn} turn
 * @property {number[]} x
 * @property {number[]} y
 * @property {string[]} words
 * @property {number[][]} region  rows of y; index of the fastest word, or -1
 * @property {Curve[]} curves
 *
 * @typedef {"metric" | "aviation"} Units
 */
export {};
