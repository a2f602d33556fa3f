/* A controller in plain C that keeps every law it can be held to: of A and B, the joint that turns faster is braked by its speed, and on whatever its
 * sensors cannot mean it lets go.
 *
 * What is believed is a sample with the next number, counts that a hand can turn to in one sample, and a force that the sensor can give. After any other
 * sample no brake has current until QUIET samples in a row were believed: a count that jumped comes back within 40, and a window of speed has no jump in
 * it then. */

#include <math.h>
#include <string.h>

#include "rigproof_controller.h"

/* Current for a speed, A·s/rad. */
#define GAIN_A_S_PER_RAD 0.3
/* Below this speed nothing is braked: it is a few counts in a window, rad/s. */
#define STANDING_RAD_S 0.02
/* The samples over which the speed is taken. */
#define WINDOW 16
/* Samples that have to be believed in a row before it brakes. */
#define QUIET 64

static RigproofControllerSettings rig;
static uint32_t last_number;
static int32_t last_counts[2];
/* The counts of the newest samples, in a ring. */
static int32_t ring[WINDOW][2];
static unsigned newest;
/* Samples believed in a row. */
static unsigned believed;
/* Whether a sample has come. */
static int begun;

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
    memset(last_counts, 0, sizeof last_counts);
    memset(ring, 0, sizeof ring);
    newest = 0;
    believed = 0;
    begun = 0;
    return 0;
}

/* Angle between two counts of a joint, rad; the counter may wrap round. */
static double turned_rad(int joint, int32_t from, int32_t to)
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
    if (!begun) {
        return 1;
    }
    /* A sample that was missed, or the same one again; the number passes its greatest. */
    if (sensed->number != (uint32_t)(last_number + 1)) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        double most_rad = rig.greatest_rate_rad_s * rig.sample_s;
        if (!(fabs(turned_rad(i, last_counts[i], sensed->counts[i])) <= most_rad)) {
            return 0;
        }
    }
    return 1;
}

int32_t rigproof_controller_tick(const RigproofControllerSensed *sensed, RigproofControllerCommanded *commanded)
{
    memset(commanded->currents_a, 0, sizeof commanded->currents_a);
    believed = is_believed(sensed) ? believed + 1 : 0;
    if (believed > 2 * QUIET) {
        believed = 2 * QUIET;
    }
    begun = 1;
    last_number = sensed->number;
    memcpy(last_counts, sensed->counts, sizeof last_counts);
    newest = (newest + 1) % WINDOW;
    int32_t oldest[2];
    memcpy(oldest, ring[newest], sizeof oldest);
    memcpy(ring[newest], sensed->counts, sizeof ring[newest]);
    if (believed < QUIET) {
        return 0;
    }
    double window_s = WINDOW * rig.sample_s;
    double a_rad_s = fabs(turned_rad(0, oldest[0], sensed->counts[0])) / window_s;
    double b_rad_s = fabs(turned_rad(1, oldest[1], sensed->counts[1])) / window_s;
    double faster_rad_s = fmax(a_rad_s, b_rad_s);
    /* In the order A, E, B, C. */
    int brake = a_rad_s >= b_rad_s ? 0 : 2;
    if (faster_rad_s > STANDING_RAD_S) {
        commanded->currents_a[brake] = fmin(GAIN_A_S_PER_RAD * faster_rad_s, rig.greatest_current_a);
    }
    return 0;
}

void rigproof_controller_shutdown(void)
{
}
