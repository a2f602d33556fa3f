/* A program without a C library, an allocator or an operating system: it links only if tick and monitor need none of them.
 *
 * The four functions on memory are what a compiler may always ask for; a bare-metal toolchain brings them. */

#include "rigproof_monitor_constants.h"

void *memcpy(void *to, const void *from, size_t size)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    while (size--) {
        *t++ = *f++;
    }
    return to;
}

void *memmove(void *to, const void *from, size_t size)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    if (t <= f) {
        return memcpy(to, from, size);
    }
    while (size--) {
        t[size] = f[size];
    }
    return to;
}

void *memset(void *to, int value, size_t size)
{
    unsigned char *t = to;
    while (size--) {
        *t++ = (unsigned char)value;
    }
    return to;
}

int memcmp(const void *one, const void *other, size_t size)
{
    const unsigned char *a = one, *b = other;
    for (; size--; a++, b++) {
        if (*a != *b) {
            return *a - *b;
        }
    }
    return 0;
}

static RigproofTick tick;
static RigproofMonitor monitor;
volatile double current_a;

void start(void)
{
    RigproofTickSettings settings;
    RigproofTickSensed sensed = {sizeof sensed, RIGPROOF_TICK_VERSION, 0, {0, 0}, {0.0, 0.0}};
    RigproofTickCommand command;
    RigproofMonitorReport report;
    settings.size = sizeof settings;
    command.size = sizeof command;
    tick.size = sizeof tick;
    monitor.size = sizeof monitor;
    report.size = sizeof report;
    settings.version = command.version = tick.version = RIGPROOF_TICK_VERSION;
    monitor.version = report.version = RIGPROOF_TICK_VERSION;
    if (rigproof_tick_thesis(&settings, 4) == RIGPROOF_TICK_STATUS_OK &&
        rigproof_tick_create(&tick, &settings) == RIGPROOF_TICK_STATUS_OK &&
        rigproof_monitor_create(&monitor, &settings, &RIGPROOF_MONITOR_FOUR_BRAKE) == RIGPROOF_TICK_STATUS_OK) {
        for (;; sensed.number++) {
            rigproof_tick_step(&tick, &sensed, &command);
            rigproof_monitor_watch(&monitor, &sensed, &command, &report);
            current_a = command.currents_a[0];
        }
    }
}
