/* A controller of an axis in plain C, with nothing but rigproof_axis_controller.h: a spring to the target, and a damper.
 *
 * It is tuned to the inertia that it is told: STIFFNESS is that of the spring, and the damper is DAMPING of the critical one. */

#include <math.h>

#include "rigproof_axis_controller.h"

#ifndef STIFFNESS
#define STIFFNESS 4000.0
#endif
#ifndef DAMPING
#define DAMPING 0.9
#endif

static double damper;
static double greatest_effort;

uint32_t rigproof_axis_controller_version(void)
{
    return RIGPROOF_AXIS_CONTROLLER_VERSION;
}

int32_t rigproof_axis_controller_init(const RigproofAxisControllerSettings *settings)
{
    damper = 2.0 * DAMPING * sqrt(STIFFNESS * settings->inertia);
    greatest_effort = settings->greatest_effort;
    return settings->motion != RIGPROOF_AXIS_CONTROLLER_MOTION_LINEAR;
}

int32_t rigproof_axis_controller_tick(const RigproofAxisControllerSensed *sensed, RigproofAxisControllerCommanded *commanded)
{
    double behind = sensed->target_position - sensed->position;
    double slower = sensed->target_velocity - sensed->velocity;
    double effort = STIFFNESS * behind + damper * slower;
    commanded->effort = fmax(-greatest_effort, fmin(greatest_effort, effort));
    return 0;
}

void rigproof_axis_controller_shutdown(void)
{
}
