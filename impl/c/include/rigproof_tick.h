/* The tick of rigproof's controller for C. Made by cbindgen from impl/c/src: change it there. */

#ifndef RIGPROOF_TICK_H
#define RIGPROOF_TICK_H

#include <stdint.h>
#include <stddef.h>

/*
 Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
 struct over; one of another size or version is refused. Nothing is written to it, but a command that differs in its version alone loses its
 currents.
 */
#define RIGPROOF_TICK_VERSION 2

/*
 Size of a controller, words of eight bytes.
 */
#define RIGPROOF_TICK_WORDS 384

/*
 Size of a monitor, words of eight bytes.
 */
#define RIGPROOF_MONITOR_WORDS 3584

/*
 Numbers that a monitor watches: gains and levels of A, E, B, C, bias of A and B.
 */
#define RIGPROOF_MONITOR_WATCHED 10

/*
 Numbers that it estimates: those, slowness of A, E, B, C, the masses of both sides, and the payload.
 */
#define RIGPROOF_MONITOR_NUMBERS 17

/*
 Most corners of a path.
 */
#define RIGPROOF_MOST_CORNERS 16

/*
 How a call ended.
 */
typedef enum RigproofTickStatus {
  /*
   As it should.
   */
  RIGPROOF_TICK_STATUS_OK = 0,
  /*
   A pointer is null or not aligned.
   */
  RIGPROOF_TICK_STATUS_BAD_POINTER = 1,
  /*
   Size or version are not those of this library.
   */
  RIGPROOF_TICK_STATUS_BAD_VERSION = 2,
  /*
   A setting is outside its range.
   */
  RIGPROOF_TICK_STATUS_BAD_SETTINGS = 3,
  /*
   There is no controller.
   */
  RIGPROOF_TICK_STATUS_NOT_CREATED = 4,
} RigproofTickStatus;

/*
 The control laws that C can choose; in the settings their number is given.
 */
typedef enum RigproofTickLaw {
  /*
   No brake ever acts.
   */
  RIGPROOF_TICK_LAW_UNCONTROLLED = 0,
  /*
   Proportional velocity control (§6.3).
   */
  RIGPROOF_TICK_LAW_PROPORTIONAL = 1,
  /*
   SDOF velocity control (§6.2).
   */
  RIGPROOF_TICK_LAW_SDOF = 2,
} RigproofTickLaw;

/*
 Why these currents.
 */
typedef enum RigproofTickReason {
  /*
   One brake was chosen.
   */
  RIGPROOF_TICK_REASON_CHOSEN = 0,
  /*
   Two brakes were chosen together.
   */
  RIGPROOF_TICK_REASON_CHOSEN_PAIR = 1,
  /*
   All brakes hold: none helps and the operator pushes away from the path.
   */
  RIGPROOF_TICK_REASON_LOCKED_PUSHED_AWAY = 2,
  /*
   All brakes hold: the tip moves against the desired direction.
   */
  RIGPROOF_TICK_REASON_LOCKED_MOVING_BACK = 3,
  /*
   None: the tip is on the path, or inside its gap.
   */
  RIGPROOF_TICK_REASON_INSIDE_GAP = 4,
  /*
   None: the tip is on the free side of the obstacle's boundary.
   */
  RIGPROOF_TICK_REASON_FREE_SIDE = 5,
  /*
   None: no brake helps, and the operator does not push away from the path.
   */
  RIGPROOF_TICK_REASON_NONE_HELPS = 6,
  /*
   None: the linkage is at a singularity.
   */
  RIGPROOF_TICK_REASON_SINGULAR_POSE = 7,
  /*
   None: nothing calls for a force.
   */
  RIGPROOF_TICK_REASON_NOTHING_TO_DO = 8,
  /*
   None: an input is not a finite number, or beyond what its sensor can give.
   */
  RIGPROOF_TICK_REASON_UNDEFINED_INPUT = 9,
  /*
   None: this method never brakes.
   */
  RIGPROOF_TICK_REASON_UNCONTROLLED = 10,
  /*
   None: too few good samples since the start or since the last fault.
   */
  RIGPROOF_TICK_REASON_STARTING = 11,
  /*
   None: no new sample came for too long, or one was missed.
   */
  RIGPROOF_TICK_REASON_STALE_SAMPLE = 12,
  /*
   None: an encoder moved faster than a hand can, or stands where its joint cannot.
   */
  RIGPROOF_TICK_REASON_JUMPED_COUNTS = 13,
  /*
   None: the control law asked for what no brake may be given.
   */
  RIGPROOF_TICK_REASON_REFUSED_COMMAND = 14,
} RigproofTickReason;

/*
 Why the rig is not what was certified.
 */
typedef enum RigproofMonitorAlarm {
  /*
   It is, as far as was seen.
   */
  RIGPROOF_MONITOR_ALARM_NONE = 0,
  /*
   No good sample came for longer than in any trial.
   */
  RIGPROOF_MONITOR_ALARM_SENSOR = 1,
  /*
   A command is no current of a brake that is there.
   */
  RIGPROOF_MONITOR_ALARM_COMMAND = 2,
  /*
   The tip is where it was in no trial.
   */
  RIGPROOF_MONITOR_ALARM_PLACE = 3,
  /*
   The tip is faster than in any trial.
   */
  RIGPROOF_MONITOR_ALARM_SPEED = 4,
  /*
   The hand pushes harder than in any trial.
   */
  RIGPROOF_MONITOR_ALARM_FORCE = 5,
  /*
   Place, speed and force came together in no trial.
   */
  RIGPROOF_MONITOR_ALARM_CELL = 6,
  /*
   The torque that current makes at a joint's brake is outside its interval.
   */
  RIGPROOF_MONITOR_ALARM_GAIN = 7,
  /*
   Friction without current at a joint is outside its interval.
   */
  RIGPROOF_MONITOR_ALARM_FRICTION = 8,
  /*
   A constant torque at A or B is outside its interval.
   */
  RIGPROOF_MONITOR_ALARM_BIAS = 9,
  /*
   The motion is further from the model than in any trial.
   */
  RIGPROOF_MONITOR_ALARM_MOTION = 10,
} RigproofMonitorAlarm;

/*
 A controller. Its memory is the caller's and its content, but for size and version, this library's; it may be copied with memcpy.
 */
typedef struct RigproofTick {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  uint64_t mark;
  uint64_t words[RIGPROOF_TICK_WORDS];
} RigproofTick;

/*
 What is fixed about a rig, its law and its path. `rigproof_tick_thesis` fills it in.
 */
typedef struct RigproofTickSettings {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  /*
   How many brakes: 3 (A, E, B) or 4 (A, E, B, C).
   */
  uint32_t brakes;
  /*
   The law: a number of `RigproofTickLaw`.
   */
  uint32_t law;
  /*
   Lengths of AE, ED, BC, CD and AB, m.
   */
  double arms_m[5];
  /*
   Counts a turn of the encoders on A and B.
   */
  uint32_t counts_per_turn[2];
  /*
   Their counts where the angle is zero.
   */
  int32_t zero_counts[2];
  /*
   Time from one sample to the next, s.
   */
  double sample_s;
  /*
   Greatest rate at which a base joint is believed to turn, rad/s.
   */
  double greatest_rate_rad_s;
  /*
   Greatest component of a tip force that is believed, N.
   */
  double greatest_force_n;
  /*
   Greatest force asked of a brake at the tip, N.
   */
  double greatest_desired_force_n;
  /*
   Boundary of the velocity field, m.
   */
  double boundary_m;
  /*
   Gain of proportional control, N·s/m.
   */
  double gain_n_s_per_m;
  /*
   Gap of SDOF control, m; 0 for none.
   */
  double gap_m;
  /*
   How many corners the path has: 2 for an endless line, more for a chain.
   */
  uint32_t corners;
  /*
   Whether the chain returns to its first corner: 0 or 1.
   */
  uint32_t closed;
  /*
   The corners, x and y, m.
   */
  double corners_m[RIGPROOF_MOST_CORNERS][2];
} RigproofTickSettings;

/*
 What a tick is told.
 */
typedef struct RigproofTickSensed {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  /*
   Number of the sample: one more than that of the sample before, then 0 after the greatest.
   */
  uint32_t number;
  /*
   Counts of the encoders on A and B.
   */
  int32_t counts[2];
  /*
   Force of the operator on the tip, x and y, N.
   */
  double tip_force_n[2];
} RigproofTickSensed;

/*
 What a tick asks of the amplifiers.
 */
typedef struct RigproofTickCommand {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  /*
   Brake currents, A, in the order A, E, B, C: 0 to 1.
   */
  double currents_a[4];
  /*
   Why: a number of `RigproofTickReason`.
   */
  uint32_t reason;
  /*
   The brakes that were chosen, 0 to 3 in the order A, E, B, C; -1 for none.
   */
  int32_t chosen[2];
} RigproofTickCommand;

/*
 A monitor. Its memory is the caller's and its content, but for size and version, this library's.
 */
typedef struct RigproofMonitor {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  uint64_t mark;
  uint64_t words[RIGPROOF_MONITOR_WORDS];
} RigproofMonitor;

/*
 A brake as a certificate has it, with the coefficients of tables 3.1 to 3.3 in their order.
 */
typedef struct RigproofMonitorBrake {
  /*
   Width of the backlash, degrees.
   */
  double backlash_width_deg;
  /*
   k1 to k5 of the torque gain (3.3).
   */
  double torque_gain[5];
  /*
   `a_avg` and a1 to a6 of the rising time constant (3.5).
   */
  double rising[7];
  /*
   The same of the falling one (3.6).
   */
  double falling[7];
  /*
   Currents that were measured, A.
   */
  double current_range_a[2];
  /*
   Speeds that were measured, rpm.
   */
  double speed_range_rpm[2];
} RigproofMonitorBrake;

/*
 What is certified, and how sure the monitor has to be. `rigproof certify monitor` writes it.
 */
typedef struct RigproofMonitorConstants {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  /*
   How many brakes: 3 (A, E, B) or 4 (A, E, B, C).
   */
  uint32_t brakes;
  /*
   Samples in a row outside of what was covered that raise an alarm.
   */
  uint32_t hold;
  /*
   Samples in a row without a good one that raise an alarm.
   */
  uint32_t longest_fault;
  /*
   0.
   */
  uint32_t reserved;
  /*
   The cells in which samples lay, a bit each.
   */
  uint64_t cells;
  /*
   Mass, kg, inertia about the centre of mass, kg·m², and its distance from the first joint, m, of AE, ED, BC, CD.
   */
  double arms[4][3];
  /*
   Mass at the tip, kg.
   */
  double payload_kg;
  /*
   The brakes A, E, B, C.
   */
  struct RigproofMonitorBrake brake[4];
  /*
   Viscous friction of A, E, B, C, N·m·s/rad.
   */
  double viscous_nm_s[4];
  /*
   Dry friction beside the brakes', N·m.
   */
  double dry_nm[4];
  /*
   Constant torque against each joint, N·m.
   */
  double constant_nm[4];
  /*
   Share by which the width of a backlash may be another.
   */
  double backlash_share;
  /*
   Lower ends of gains and levels of A, E, B, C, bias of A and B, slowness of A, E, B, C, masses of both sides, and payload.
   */
  double low[RIGPROOF_MONITOR_NUMBERS];
  /*
   Their upper ends.
   */
  double high[RIGPROOF_MONITOR_NUMBERS];
  /*
   Their spreads.
   */
  double spread[RIGPROOF_MONITOR_NUMBERS];
  /*
   Time over which the monitor forgets what it learned, s.
   */
  double memory_s;
  /*
   Shares of inertial and braking impulses that the model may miss.
   */
  double missed_share[2];
  /*
   By how many standard deviations a number has to be beyond its end.
   */
  double levels[RIGPROOF_MONITOR_WATCHED];
  /*
   Greatest mean square of the normalised surprise.
   */
  double surprise;
  /*
   Least and greatest x, least and greatest y of the tip, m.
   */
  double tip_m[4];
  /*
   Greatest speed of the tip, m/s.
   */
  double speed_m_s;
  /*
   Greatest force on it, N.
   */
  double force_n;
  /*
   What lies farther from the base joints' line is far, m.
   */
  double far_m;
  /*
   Speeds between still, slow and fast, m/s.
   */
  double speeds_m_s[2];
  /*
   Forces between light, middle and strong, N.
   */
  double forces_n[2];
} RigproofMonitorConstants;

/*
 What the monitor makes of a sample.
 */
typedef struct RigproofMonitorReport {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_TICK_VERSION`.
   */
  uint32_t version;
  /*
   A number of `RigproofMonitorAlarm`; once it is not 0 it stays.
   */
  uint32_t alarm;
  /*
   The joint that it names, 0 to 3 in the order A, E, B, C; -1 for none.
   */
  int32_t joint;
  /*
   Whether a sensor is wrong in this sample.
   */
  uint32_t is_faulty;
} RigproofMonitorReport;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Makes a controller in `tick` that has seen nothing.

 # Safety
 `tick` must be null or point to `tick->size` bytes that may be written, `settings` be null or point to `settings->size` bytes that may be
 read.
 */
enum RigproofTickStatus rigproof_tick_create(struct RigproofTick *tick,
                                             const struct RigproofTickSettings *settings);

/*
 The currents of one tick, and why. Bounded work, whatever is sensed. Whatever goes wrong, the command has no current, with one exception: where its
 pointer or its size are wrong nothing can be written, and it keeps what it held. So a caller takes every status but `OK` for no current.

 # Safety
 Each pointer must be null or point to as many bytes as its size says; `tick` to a controller that was created (one that was not is told by its mark,
 unless chance wrote the mark) and that no other thread uses.
 */
enum RigproofTickStatus rigproof_tick_step(struct RigproofTick *tick,
                                           const struct RigproofTickSensed *sensed,
                                           struct RigproofTickCommand *command);

/*
 Makes a monitor in `monitor` that has seen nothing, for the rig of a tick's settings.

 # Safety
 Each pointer must be null or point to as many bytes as its size says; `monitor` to bytes that may be written.
 */
enum RigproofTickStatus rigproof_monitor_create(struct RigproofMonitor *monitor,
                                                const struct RigproofTickSettings *settings,
                                                const struct RigproofMonitorConstants *constants);

/*
 Watches a sample and the command that the tick gave for it, and lets go where it has to: then the command has no current. Bounded work,
 whatever is told. As of `rigproof_tick_step`, a caller takes every status but `OK` for no current.

 # Safety
 Each pointer must be null or point to as many bytes as its size says; `monitor` to a monitor that was created and that no other
 thread uses; `command` and `report` to bytes that may be written.
 */
enum RigproofTickStatus rigproof_monitor_watch(struct RigproofMonitor *monitor,
                                               const struct RigproofTickSensed *sensed,
                                               struct RigproofTickCommand *command,
                                               struct RigproofMonitorReport *report);

/*
 Fills in the thesis's rig with 3 or 4 brakes; law, gain, gap and path are left to choose. Size and version have to be there already.

 # Safety
 `settings` must be null or point to `settings->size` bytes that may be read and written.
 */
enum RigproofTickStatus rigproof_tick_thesis(struct RigproofTickSettings *settings,
                                             uint32_t brakes);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* RIGPROOF_TICK_H */
