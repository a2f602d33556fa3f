/* A controller in plain C, with nothing but rigproof_controller.h: a damper. Of A and B, the joint that turns faster is braked by its speed.
 *
 * It keeps what it knows in global variables, as generated code does: one trial is over before the next begins. */

#include "damping.h"

static uint32_t last_number;
static int32_t counts_of[WINDOW + 1][2];
static int known;
static double currents_a[4];

int32_t rigproof_controller_init(const RigproofControllerSettings *settings)
{
    last_number = 0;
    known = 0;
    memset(currents_a, 0, sizeof currents_a);
    return settled(settings);
}

static int is_believed(const RigproofControllerSensed *sensed)
{
    if (!is_force(sensed)) {
        return 0;
    }
    return known == 0 || (sensed->number == last_number + 1 && is_turn(counts_of[known - 1], sensed->counts));
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
            brake_the_faster(counts_of[0], sensed->counts, currents_a);
        }
    }
    memcpy(commanded->currents_a, currents_a, sizeof currents_a);
    return 0;
}

void rigproof_controller_shutdown(void)
{
}
