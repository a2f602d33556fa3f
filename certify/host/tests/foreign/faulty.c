/* A controller that asks for a quarter of its greatest current on brake A, with the faults that the compiler's command line puts in. */

#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rigproof_controller.h"

#ifndef VERSION
#define VERSION RIGPROOF_CONTROLLER_VERSION
#endif
#ifndef AT_OPENING
#define AT_OPENING
#endif
#ifndef IN_INIT
#define IN_INIT
#endif
#ifndef IN_TICK
#define IN_TICK
#endif
#ifndef IN_SHUTDOWN
#define IN_SHUTDOWN
#endif

/* The fault comes in this tick of a trial. */
#define FAULTY_TICK 3

extern void defined_nowhere(void);
static RigproofControllerSettings told;
static int ticks, trials;

__attribute__((constructor)) static void opened(void)
{
    AT_OPENING;
}

uint32_t rigproof_controller_version(void)
{
    return VERSION;
}

int32_t rigproof_controller_init(const RigproofControllerSettings *settings)
{
    told = *settings;
    ticks = 0;
    trials++;
    IN_INIT;
    return 0;
}

#ifndef WITHOUT_TICK
int32_t rigproof_controller_tick(const RigproofControllerSensed *sensed, RigproofControllerCommanded *commanded)
{
    (void)sensed;
    double *currents_a = commanded->currents_a;
    currents_a[0] = 0.25 * told.greatest_current_a;
    currents_a[1] = currents_a[2] = currents_a[3] = 0.0;
    ticks++;
    if (ticks == FAULTY_TICK) {
        IN_TICK;
    }
    return 0;
}
#endif

void rigproof_controller_shutdown(void)
{
    IN_SHUTDOWN;
}
