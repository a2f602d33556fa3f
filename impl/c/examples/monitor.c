/* Watches what it reads: a line a sample, with its number, the counts of A and B, the force in x and y, and the four commanded currents.
 * Prints the alarm, its joint, whether a sensor is wrong, and the currents that may leave. Built with what `rigproof certify monitor` wrote. */

#include <stdio.h>
#include <stdlib.h>

#include "rigproof_monitor_constants.h"

static RigproofMonitor monitor = {.size = sizeof(RigproofMonitor), .version = RIGPROOF_TICK_VERSION};

int main(int count, char **arguments)
{
    uint32_t brakes = count > 1 && atoi(arguments[1]) == 3 ? 3 : 4;
    const RigproofMonitorConstants *constants =
        brakes == 3 ? &RIGPROOF_MONITOR_THREE_BRAKE : &RIGPROOF_MONITOR_FOUR_BRAKE;
    RigproofTickSettings settings = {.size = sizeof settings, .version = RIGPROOF_TICK_VERSION};
    RigproofTickSensed sensed = {.size = sizeof sensed, .version = RIGPROOF_TICK_VERSION};
    RigproofTickCommand command = {.size = sizeof command, .version = RIGPROOF_TICK_VERSION};
    RigproofMonitorReport report = {.size = sizeof report, .version = RIGPROOF_TICK_VERSION};
    if (rigproof_tick_thesis(&settings, brakes) != RIGPROOF_TICK_STATUS_OK ||
        rigproof_monitor_create(&monitor, &settings, constants) != RIGPROOF_TICK_STATUS_OK) {
        return 1;
    }
    double *n = sensed.tip_force_n, *a = command.currents_a;
    while (scanf("%u %d %d %lf %lf %lf %lf %lf %lf", &sensed.number, &sensed.counts[0], &sensed.counts[1], &n[0], &n[1],
                 &a[0], &a[1], &a[2], &a[3]) == 9) {
        if (rigproof_monitor_watch(&monitor, &sensed, &command, &report) != RIGPROOF_TICK_STATUS_OK) {
            return 2;
        }
        printf("%u %d %u %a %a %a %a\n", report.alarm, report.joint, report.is_faulty, a[0], a[1], a[2], a[3]);
    }
    return 0;
}
