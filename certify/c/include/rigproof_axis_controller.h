/* What a compiled controller of an axis exports for rigproof. Made by cbindgen from certify/host/src: change it there. */

#ifndef RIGPROOF_AXIS_CONTROLLER_H
#define RIGPROOF_AXIS_CONTROLLER_H

#include <stdint.h>
#include <stddef.h>

/*
 Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
 struct over.
 */
#define RIGPROOF_AXIS_CONTROLLER_VERSION 1

/*
 How an axis moves.
 */
typedef enum RigproofAxisControllerMotion {
  /*
   It slides: travel in m, effort in N, inertia in kg.
   */
  RIGPROOF_AXIS_CONTROLLER_MOTION_LINEAR = 0,
  /*
   It turns: travel in rad, effort in N·m, inertia in kg·m².
   */
  RIGPROOF_AXIS_CONTROLLER_MOTION_ROTARY = 1,
} RigproofAxisControllerMotion;

/*
 What is fixed about an axis and a trial.
 */
typedef struct RigproofAxisControllerSettings {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_AXIS_CONTROLLER_VERSION`.
   */
  uint32_t version;
  /*
   How the axis moves: a number of `RigproofAxisControllerMotion`.
   */
  uint32_t motion;
  /*
   Nothing; 0.
   */
  uint32_t reserved;
  /*
   Time from one tick to the next, s.
   */
  double sample_s;
  /*
   Mass, kg, or moment of inertia, kg·m².
   */
  double inertia;
  /*
   Greatest magnitude of an effort, N or N·m.
   */
  double greatest_effort;
  /*
   Resolution of the sensed position, m or rad; 0 where it is not known.
   */
  double position_quantum;
} RigproofAxisControllerSettings;

/*
 What a tick is told.
 */
typedef struct RigproofAxisControllerSensed {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_AXIS_CONTROLLER_VERSION`.
   */
  uint32_t version;
  /*
   Number of the sample, from 0.
   */
  uint32_t number;
  /*
   Nothing; 0.
   */
  uint32_t reserved;
  /*
   Where the axis is, as its encoder shows it, m or rad.
   */
  double position;
  /*
   How fast it moves, m/s or rad/s: the change of that position over a few samples.
   */
  double velocity;
  /*
   The effort that the drive gave at the end of the sample before, N or N·m.
   */
  double effort;
  /*
   Where it is to be, m or rad.
   */
  double target_position;
  /*
   How fast it is to move, m/s or rad/s.
   */
  double target_velocity;
} RigproofAxisControllerSensed;

/*
 What a tick asks of the drive.
 */
typedef struct RigproofAxisControllerCommanded {
  /*
   Size of this struct, bytes.
   */
  uint32_t size;
  /*
   `RIGPROOF_AXIS_CONTROLLER_VERSION`.
   */
  uint32_t version;
  /*
   Effort in the sense of the position, N or N·m: at most `greatest_effort` to either side. It is not a number before each call: write it.
   */
  double effort;
} RigproofAxisControllerCommanded;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 `RIGPROOF_AXIS_CONTROLLER_VERSION` of the header that the controller was compiled with. It is asked before anything else.
 */
extern uint32_t rigproof_axis_controller_version(void);

/*
 Begins afresh: whatever an earlier `init` and its ticks left is forgotten. It is called before the first tick of every trial, on one thread, and
 one trial is over before the next begins, so that a controller may keep what it knows in global variables.

 0: it is ready. Any other: it cannot work with these settings; neither `tick` nor `shutdown` is called.
 */
extern int32_t rigproof_axis_controller_init(const struct RigproofAxisControllerSettings *settings);

/*
 The effort of one tick. `sensed` may only be read, `commanded` be written within its size; neither may be kept.

 0: the effort is written. Any other: the controller says that it failed, which ends the trial and is reported; `shutdown` is not called.
 */
extern int32_t rigproof_axis_controller_tick(const struct RigproofAxisControllerSensed *sensed,
                                             struct RigproofAxisControllerCommanded *commanded);

/*
 The trial is over. `init` may follow.
 */
extern void rigproof_axis_controller_shutdown(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* RIGPROOF_AXIS_CONTROLLER_H */
