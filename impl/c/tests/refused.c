/* Hands over what is refused and prints which command then keeps a current that it should not, or loses one that is not the library's to take. */

#include <stdio.h>

#include "rigproof_tick.h"

static RigproofTick tick;
static RigproofTickSensed sensed = {sizeof sensed, RIGPROOF_TICK_VERSION, 17, {33421, 14327}, {1.3, -2.7}};

/* One step with a command that still holds the currents of another. */
static void step(const char *what, RigproofTick *of, const RigproofTickSensed *from, uint32_t size, uint32_t version,
                 RigproofTickStatus expected, int keeps)
{
    RigproofTickCommand command = {size, version, {0.7, 0.31, 0.0, 0.9}, RIGPROOF_TICK_REASON_CHOSEN, {0, -1}};
    RigproofTickStatus status = rigproof_tick_step(of, from, &command);
    double sum_a = 0.0;
    for (int i = 0; i < 4; i++) {
        sum_a += command.currents_a[i];
    }
    if (status != expected || (sum_a > 0.0) != keeps || command.size != size || command.version != version) {
        printf("%s: status %d, %g A together\n", what, (int)status, sum_a);
    }
}

int main(void)
{
    uint32_t size = sizeof(RigproofTickCommand), version = RIGPROOF_TICK_VERSION;
    RigproofTickSensed other = sensed;
    other.version += 1;
    tick.size = sizeof tick;
    tick.version = version;
    step("no controller", &tick, &sensed, size, version, RIGPROOF_TICK_STATUS_NOT_CREATED, 0);
    step("no sample", &tick, NULL, size, version, RIGPROOF_TICK_STATUS_BAD_POINTER, 0);
    step("sample of another version", &tick, &other, size, version, RIGPROOF_TICK_STATUS_BAD_VERSION, 0);
    step("command of another version", &tick, &sensed, size, version + 1, RIGPROOF_TICK_STATUS_BAD_VERSION, 0);
    /* How much of it may be written is not known. */
    step("command of another size", &tick, &sensed, size - 8, version, RIGPROOF_TICK_STATUS_BAD_VERSION, 1);
    return 0;
}
