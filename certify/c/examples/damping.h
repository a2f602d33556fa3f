/* What the two dampers share: of A and B, the joint that turns faster is braked by its speed over a window of samples. */

#ifndef DAMPING_H
#define DAMPING_H

#include <math.h>
#include <string.h>

#include "rigproof_controller.h"

/* Current for a speed, A·s/rad. */
#define GAIN_A_S_PER_RAD 0.3
/* Below this speed nothing is braked: it is a few counts in a window, rad/s. */
#define STANDING_RAD_S 0.02
/* The samples over which the speed is taken. */
#define WINDOW 16

/* The settings of the trial. */
static RigproofControllerSettings rig;

uint32_t rigproof_controller_version(void)
{
    return RIGPROOF_CONTROLLER_VERSION;
}

/* Keeps the settings if they can be worked with: 0, or the status for `init`. */
static int32_t settled(const RigproofControllerSettings *settings)
{
    if (settings->size != sizeof *settings || settings->version != RIGPROOF_CONTROLLER_VERSION) {
        return 1;
    }
    if (!(settings->sample_s > 0.0) || settings->counts_per_turn[0] == 0 || settings->counts_per_turn[1] == 0) {
        return 2;
    }
    rig = *settings;
    return 0;
}

/* Angle between two counts of a joint, rad; the counter may wrap round. */
static double turned_rad(int joint, int32_t from, int32_t to)
{
    return (double)(int32_t)((uint32_t)to - (uint32_t)from) * (2.0 * 3.14159265358979323846 / rig.counts_per_turn[joint]);
}

/* Whether the force is one that the sensor can give. */
static int is_force(const RigproofControllerSensed *sensed)
{
    for (int i = 0; i < 2; i++) {
        /* Written so that what is not a number is not believed. */
        if (!(fabs(sensed->tip_force_n[i]) <= rig.greatest_force_n)) {
            return 0;
        }
    }
    return 1;
}

/* Whether a hand can turn both joints so far in one sample. */
static int is_turn(const int32_t from[2], const int32_t to[2])
{
    for (int i = 0; i < 2; i++) {
        if (!(fabs(turned_rad(i, from[i], to[i])) <= rig.greatest_rate_rad_s * rig.sample_s)) {
            return 0;
        }
    }
    return 1;
}

/* The current of the faster joint, by the counts of a window ago and now. */
static void brake_the_faster(const int32_t oldest[2], const int32_t counts[2], double currents_a[4])
{
    double window_s = WINDOW * rig.sample_s;
    double a_rad_s = fabs(turned_rad(0, oldest[0], counts[0])) / window_s;
    double b_rad_s = fabs(turned_rad(1, oldest[1], counts[1])) / window_s;
    double faster_rad_s = fmax(a_rad_s, b_rad_s);
    /* In the order A, E, B, C. */
    int brake = a_rad_s >= b_rad_s ? 0 : 2;
    if (faster_rad_s > STANDING_RAD_S) {
        currents_a[brake] = fmin(GAIN_A_S_PER_RAD * faster_rad_s, rig.greatest_current_a);
    }
}

#endif
