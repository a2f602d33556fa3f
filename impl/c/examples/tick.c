/* Replays samples through the tick of the controller and prints what it asks for.
 *
 * usage: tick BRAKES LAW GAIN_N_S_PER_M GAP_M CLOSED CORNERS X Y [X Y ...] < samples
 *
 * A sample is a line: number, counts of A and B, force x and y in N. A line comes out for each: currents of A, E, B and C as
 * hexadecimal floats, in A, then the reason and the chosen brakes as numbers. */

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "rigproof_tick.h"

static int settings_of(int argc, char **argv, RigproofTickSettings *settings)
{
    if (argc < 7) {
        return 0;
    }
    uint32_t brakes = (uint32_t)strtoul(argv[1], NULL, 10);
    settings->size = sizeof *settings;
    settings->version = RIGPROOF_TICK_VERSION;
    if (rigproof_tick_thesis(settings, brakes) != RIGPROOF_TICK_STATUS_OK) {
        return 0;
    }
    settings->law = (uint32_t)strtoul(argv[2], NULL, 10);
    settings->gain_n_s_per_m = strtod(argv[3], NULL);
    settings->gap_m = strtod(argv[4], NULL);
    settings->closed = (uint32_t)strtoul(argv[5], NULL, 10);
    settings->corners = (uint32_t)strtoul(argv[6], NULL, 10);
    if (settings->corners > RIGPROOF_MOST_CORNERS || argc != 7 + 2 * (int)settings->corners) {
        return 0;
    }
    for (uint32_t i = 0; i < settings->corners; i++) {
        settings->corners_m[i][0] = strtod(argv[7 + 2 * i], NULL);
        settings->corners_m[i][1] = strtod(argv[8 + 2 * i], NULL);
    }
    return 1;
}

int main(int argc, char **argv)
{
    RigproofTickSettings settings;
    RigproofTick tick;
    RigproofTickSensed sensed;
    RigproofTickCommand command;
    if (!settings_of(argc, argv, &settings)) {
        fprintf(stderr, "usage: tick BRAKES LAW GAIN_N_S_PER_M GAP_M CLOSED CORNERS X Y [X Y ...] < samples\n");
        return 2;
    }
    tick.size = sizeof tick;
    sensed.size = sizeof sensed;
    command.size = sizeof command;
    tick.version = sensed.version = command.version = RIGPROOF_TICK_VERSION;
    RigproofTickStatus status = rigproof_tick_create(&tick, &settings);
    if (status != RIGPROOF_TICK_STATUS_OK) {
        fprintf(stderr, "no controller: status %d\n", (int)status);
        return 3;
    }
    while (scanf("%" SCNu32 " %" SCNd32 " %" SCNd32 " %la %la", &sensed.number, &sensed.counts[0], &sensed.counts[1],
                 &sensed.tip_force_n[0], &sensed.tip_force_n[1]) == 5) {
        status = rigproof_tick_step(&tick, &sensed, &command);
        if (status != RIGPROOF_TICK_STATUS_OK) {
            fprintf(stderr, "no command: status %d\n", (int)status);
            return 4;
        }
        printf("%a %a %a %a %" PRIu32 " %" PRId32 " %" PRId32 "\n", command.currents_a[0], command.currents_a[1],
               command.currents_a[2], command.currents_a[3], command.reason, command.chosen[0], command.chosen[1]);
    }
    return 0;
}
