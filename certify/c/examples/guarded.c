/* A controller in plain C that keeps every law it can be held to: of A and B, the joint that turns faster is braked by its speed, and on whatever its
 * sensors cannot mean it lets go.
 *
 * What is believed is a sample with the next number, counts that a hand can turn to in one sample, and a force that the sensor can give. After any other
 * sample no brake has current until QUIET samples in a row were believed: a count that jumped comes back within 40, and a window of speed has no jump in
 * it then. */

#include "damping.h"

/* Samples that have to be believed in a row before it brakes. */
#define QUIET 64

static uint32_t last_number;
static int32_t last_counts[2];
/* The counts of the newest samples, in a ring. */
static int32_t ring[WINDOW][2];
static unsigned newest;
/* Samples believed in a row. */
static unsigned believed;
/* Whether a sample has come. */
static int begun;

int32_t rigproof_controller_init(const RigproofControllerSettings *settings)
{
    last_number = 0;
    memset(last_counts, 0, sizeof last_counts);
    memset(ring, 0, sizeof ring);
    newest = 0;
    believed = 0;
    begun = 0;
    return settled(settings);
}

static int is_believed(const RigproofControllerSensed *sensed)
{
    if (!is_force(sensed)) {
        return 0;
    }
    if (!begun) {
        return 1;
    }
    /* A sample that was missed, or the same one again; the number passes its greatest. */
    if (sensed->number != (uint32_t)(last_number + 1)) {
        return 0;
    }
    return is_turn(last_counts, sensed->counts);
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
    if (believed >= QUIET) {
        brake_the_faster(oldest, sensed->counts, commanded->currents_a);
    }
    return 0;
}

void rigproof_controller_shutdown(void)
{
}
