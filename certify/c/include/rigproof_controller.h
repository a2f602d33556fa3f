/* What a compiled controller exports for rigproof. Made by cbindgen from certify/host/src: change it there. */

#ifndef RIGPROOF_CONTROLLER_H
#define RIGPROOF_CONTROLLER_H

#include <stdint.h>
#include <stddef.h>

/*
 Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
 struct over.
 */
#define RIGPROOF_CONTROLLER_VERSION 1

/*
 Most points of a chain or a spline.
 */
#define RIGPROOF_CONTROLLER_MOST_POINTS 64

/*
 What kind of path the operator is to follow or to stay out of.
 */
typedef enum RigproofControllerTask {
  /*
   A chain of straight lines through the points; two points are a line.
   */
  RIGPROOF_CONTROLLER_TASK_CHAIN = 0,
  /*
   An arc about a centre.
   */
  RIGPROOF_CONTROLLER_TASK_ARC = 1,
  /*
   A natural cubic spline through the points.
   */
  RIGPROOF_CONTROLLER_TASK_SPLINE = 2,
} RigproofControllerTask;

/*
 What is fixed about a rig, and the path. Lengths are in m, in the plane of the rig: A lies at (-AB/2, 0), B at (AB/2, 0), the tip works where y is
 positive, and angles grow counter-clockwise from x. Arm AE carries arm ED, arm BC carries arm CD, and ED and CD meet in the tip. Joints and brakes
 come in the order A, E, B, C.
 */
typedef struct RigproofControllerSettings {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_CONTROLLER_VERSION`.
   */
  uint32_t version;
  /*
   How many brakes: 3 (A, E, B) or 4 (A, E, B, C). With 3 the current of C has to be 0.
   */
  uint32_t brakes;
  /*
   The kind of the path: a number of `RigproofControllerTask`.
   */
  uint32_t task;
  /*
   Lengths of AE, ED, BC, CD and AB, m.
   */
  double arms_m[5];
  /*
   Counts a turn of the encoders on A and B.
   */
  uint32_t counts_per_turn[2];
  /*
   Their counts where the angle is zero. Counts grow as the arm turns counter-clockwise.
   */
  int32_t zero_counts[2];
  /*
   Time from one tick to the next, s.
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
   Greatest current of a brake, A; the least is 0.
   */
  double greatest_current_a;
  /*
   Chain and spline: how many points, 2 to `RIGPROOF_CONTROLLER_MOST_POINTS`. Arc: 0.
   */
  uint32_t points;
  /*
   Nothing; 0.
   */
  uint32_t reserved;
  /*
   Arc: its centre, x and y, m.
   */
  double centre_m[2];
  /*
   Arc: its radius, m.
   */
  double radius_m;
  /*
   Arc: the angle where it begins, rad, from x towards y.
   */
  double from_rad;
  /*
   Arc: the angle where it ends, rad; below `from_rad` if it runs clockwise.
   */
  double to_rad;
  /*
   Chain and spline: the points, x and y, m; those beyond `points` are 0.
   */
  double points_m[RIGPROOF_CONTROLLER_MOST_POINTS][2];
} RigproofControllerSettings;

/*
 What a tick is told. It may be wrong, as sensors are: repeated, missed, jumping, not a number.
 */
typedef struct RigproofControllerSensed {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_CONTROLLER_VERSION`.
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
   Nothing; 0.
   */
  uint32_t reserved;
  /*
   Force of the operator on the tip, x and y, N.
   */
  double tip_force_n[2];
} RigproofControllerSensed;

/*
 What a tick asks of the amplifiers.
 */
typedef struct RigproofControllerCommanded {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_CONTROLLER_VERSION`.
   */
  uint32_t version;
  /*
   Brake currents, A, in the order A, E, B, C: 0 to `greatest_current_a`. They are not numbers before each call: write all four.
   */
  double currents_a[4];
} RigproofControllerCommanded;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 `RIGPROOF_CONTROLLER_VERSION` of the header that the controller was compiled with. It is asked before anything else.
 */
extern uint32_t rigproof_controller_version(void);

/*
 Begins afresh: whatever an earlier `init` and its ticks left is forgotten. It is called before the first tick of every trial, on one thread, and
 one trial is over before the next begins, so that a controller may keep what it knows in global variables.

 0: it is ready. Any other: it cannot work with these settings; neither `tick` nor `shutdown` is called.
 */
extern int32_t rigproof_controller_init(const struct RigproofControllerSettings *settings);

/*
 The currents of one tick. `sensed` may only be read, `commanded` be written within its size; neither may be kept.

 0: the currents are written. Any other: the controller says that it failed, which ends the trial and is reported; `shutdown` is not called.
 */
extern int32_t rigproof_controller_tick(const struct RigproofControllerSensed *sensed,
                                        struct RigproofControllerCommanded *commanded);

/*
 The trial is over. `init` may follow.
 */
extern void rigproof_controller_shutdown(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* RIGPROOF_CONTROLLER_H */
