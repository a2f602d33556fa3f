/* A controller in plain C, with nothing but rigproof_controller.h: a damper. Of A and B, the joint that turns faster is braked by its speed.
 *
 * It keeps what it knows in global variables, as generated code does: one trial is over before the next begins. */

#include <math.h>
#include <string.h>

#include "rigproof_controller.h"

/* Current for a speed, A·s/rad. */
#define GAIN_A_S_PER_RAD 0.3
/* Below this speed nothing is braked: it is a few counts in a window, rad/s. */
#define STANDING_RAD_S 0.02
/* The samples over which the speed is taken. */
#define WINDOW 16

static RigproofControllerSettings rig;
static uint32_t last_number;
static int32_t counts_of[WINDOW + 1][2];
static int known;
static double currents_a[4];

uint32_t rigproof_controller_version(void)
{
    return RIGPROOF_CONTROLLER_VERSION;
}

int32_t rigproof_controller_init(const RigproofControllerSettings *settings)
{
    if (settings->size != sizeof *settings || settings->version != RIGPROOF_CONTROLLER_VERSION) {
        return 1;
    }
    if (!(settings->sample_s > 0.0) || settings->counts_per_turn[0] == 0 || settings->counts_per_turn[1] == 0) {
        return 2;
    }
    rig = *settings;
    last_number = 0;
    known = 0;
    memset(currents_a, 0, sizeof currents_a);
    return 0;
}

/* Angle of so many counts of a joint, rad; the counter may wrap round. */
static double angle_rad(int joint, int32_t from, int32_t to)
{
    return (double)(int32_t)((uint32_t)to - (uint32_t)from) * (2.0 * 3.14159265358979323846 / rig.counts_per_turn[joint]);
}

static int is_believed(const RigproofControllerSensed *sensed)
{
    for (int i = 0; i < 2; i++) {
        /* Written so that what is not a number is not believed. */
        if (!(fabs(sensed->tip_force_n[i]) <= rig.greatest_force_n)) {
            return 0;
        }
    }
    if (known == 0) {
        return 1;
    }
    if (sensed->number != last_number + 1) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        double turned_rad = angle_rad(i, counts_of[known - 1][i], sensed->counts[i]);
        if (fabs(turned_rad) > rig.greatest_rate_rad_s * rig.sample_s) {
            return 0;
        }
    }
    return 1;
}

/* Keeps the newest counts of a window. */
static void keep(const RigproofControllerSensed *sensed)
{
    if (known == WINDOW + 1) {
        memmove(counts_of[0], counts_of[1], WINDOW * sizeof counts_of[0]);
        known--;
    }
    memcpy(counts_of[known], sensed->counts, sizeof counts_of[known]);
    known++;
}

int32_t rigproof_controller_tick(const RigproofControllerSensed *sensed, RigproofControllerCommanded *commanded)
{
    /* The same sample again: the same answer. Anything else that cannot be: let go, and learn the speed anew. */
    int repeated = known > 0 && sensed->number == last_number;
    if (!repeated) {
        memset(currents_a, 0, sizeof currents_a);
        if (!is_believed(sensed)) {
            known = 0;
        }
        keep(sensed);
        last_number = sensed->number;
        if (known == WINDOW + 1) {
            double window_s = WINDOW * rig.sample_s;
            double a_rad_s = fabs(angle_rad(0, counts_of[0][0], sensed->counts[0])) / window_s;
            double b_rad_s = fabs(angle_rad(1, counts_of[0][1], sensed->counts[1])) / window_s;
            double faster_rad_s = fmax(a_rad_s, b_rad_s);
            /* In the order A, E, B, C. */
            int brake = a_rad_s >= b_rad_s ? 0 : 2;
            if (faster_rad_s > STANDING_RAD_S) {
                currents_a[brake] = fmin(GAIN_A_S_PER_RAD * faster_rad_s, rig.greatest_current_a);
            }
        }
    }
    memcpy(commanded->currents_a, currents_a, sizeof currents_a);
    return 0;
}

void rigproof_controller_shutdown(void)
{
}
