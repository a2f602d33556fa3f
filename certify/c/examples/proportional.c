/* A controller in C that is made of another: rigproof's own tick (impl/c), proportional control along a line or an open chain, behind
 * rigproof_controller.h. Generated code goes behind the header in the same way: translate the settings, the sensed and the commanded. */

#include <string.h>

#include "rigproof_controller.h"
#include "rigproof_tick.h"

#ifndef GAIN_N_S_PER_M
#define GAIN_N_S_PER_M 500.0
#endif

/* What init answers when it cannot work; any number but 0. */
enum { OTHER_HEADER = 1, OTHER_PATH = 2, NO_RIG = 3, NO_CONTROLLER = 4 };

static RigproofTick controller;

uint32_t rigproof_controller_version(void)
{
    return RIGPROOF_CONTROLLER_VERSION;
}

int32_t rigproof_controller_init(const RigproofControllerSettings *told)
{
    RigproofTickSettings settings = {.size = sizeof settings, .version = RIGPROOF_TICK_VERSION};
    if (told->size != sizeof *told || told->version != RIGPROOF_CONTROLLER_VERSION) {
        return OTHER_HEADER;
    }
    if (told->task != RIGPROOF_CONTROLLER_TASK_CHAIN || told->points > RIGPROOF_MOST_CORNERS) {
        return OTHER_PATH;
    }
    /* Fills in what the two do not share: the boundary of the velocity field and the greatest force. */
    if (rigproof_tick_thesis(&settings, told->brakes) != RIGPROOF_TICK_STATUS_OK) {
        return NO_RIG;
    }
    settings.law = RIGPROOF_TICK_LAW_PROPORTIONAL;
    settings.gain_n_s_per_m = GAIN_N_S_PER_M;
    memcpy(settings.arms_m, told->arms_m, sizeof settings.arms_m);
    memcpy(settings.counts_per_turn, told->counts_per_turn, sizeof settings.counts_per_turn);
    memcpy(settings.zero_counts, told->zero_counts, sizeof settings.zero_counts);
    settings.sample_s = told->sample_s;
    settings.greatest_rate_rad_s = told->greatest_rate_rad_s;
    settings.greatest_force_n = told->greatest_force_n;
    settings.closed = 0;
    settings.corners = told->points;
    memcpy(settings.corners_m, told->points_m, told->points * sizeof told->points_m[0]);
    memset(&controller, 0, sizeof controller);
    controller.size = sizeof controller;
    controller.version = RIGPROOF_TICK_VERSION;
    return rigproof_tick_create(&controller, &settings) == RIGPROOF_TICK_STATUS_OK ? 0 : NO_CONTROLLER;
}

int32_t rigproof_controller_tick(const RigproofControllerSensed *told, RigproofControllerCommanded *commanded)
{
    RigproofTickSensed sensed = {.size = sizeof sensed, .version = RIGPROOF_TICK_VERSION, .number = told->number};
    RigproofTickCommand command = {.size = sizeof command, .version = RIGPROOF_TICK_VERSION};
    memcpy(sensed.counts, told->counts, sizeof sensed.counts);
    memcpy(sensed.tip_force_n, told->tip_force_n, sizeof sensed.tip_force_n);
    RigproofTickStatus status = rigproof_tick_step(&controller, &sensed, &command);
    memcpy(commanded->currents_a, command.currents_a, sizeof commanded->currents_a);
    return (int32_t)status;
}

void rigproof_controller_shutdown(void)
{
}
