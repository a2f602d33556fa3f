"""This file steps the five-bar with MuJoCo: two open chains of hinges whose tips an equality constraint keeps together."""

import time

import mujoco
import numpy as np
from mujoco import rollout

# "default" leaves the solver as MuJoCo has it; "stiff" asks for the hardest constraints that it allows: a reference time of two steps, the least
# that its safeguard lets pass, and impedances of 0.9999. "no slip" is its pass that takes away what friction lets creep.
CLOSURE = {"default": "", "stiff": 'solref="{two_steps} 1" solimp="0.9999 0.9999 0.001 0.5 2"'}
# Steps that a timed call takes at least, so that the call itself is no part of a step.
LEAST_STEPS = 1500
FRICTION = {"default": "", "stiff": 'solreffriction="{two_steps} 1" solimpfriction="0.9999 0.9999 0.001 0.5 2"'}


def xml(case, integrator, solver, step_s, noslip=0):
    """The rig as MuJoCo's text: the same lengths, masses, inertias about the centres of mass and dry friction."""
    two_steps = {"two_steps": f"{2.0 * step_s:.17g}"}
    friction = FRICTION[solver].format(**two_steps)

    def joint(name, at):
        loss = case["friction_nm"][at]
        dry = f'frictionloss="{loss!r}" {friction}' if loss > 0.0 else ""
        return f'<joint name="{name}" type="hinge" axis="0 0 1" {dry}/>'

    def body(arm):
        i = arm["inertia_kg_m2"]
        return f'<inertial pos="{arm["centre_m"]!r} 0 0" mass="{arm["mass_kg"]!r}" diaginertia="{i!r} {i!r} {i!r}"/>'

    def chain(x, inner, outer, inner_joint, outer_joint, tip):
        inner, outer = case["arms"][inner], case["arms"][outer]
        return f"""
        <body pos="{x!r} 0 0">{inner_joint}{body(inner)}
          <body pos="{inner["length_m"]!r} 0 0">{outer_joint}{body(outer)}
            {tip.format(at=f'{outer["length_m"]!r} 0 0')}
          </body>
        </body>"""

    half = 0.5 * case["base_m"]
    # Without an inertial frame of its own the massless body's force would act elsewhere.
    left_tip = '<site name="left" pos="{at}"/><body name="tip" pos="{at}"><inertial pos="0 0 0" mass="0" diaginertia="0 0 0"/></body>'
    left = chain(-half, "AE", "ED", joint("A", 0), joint("E", 1), left_tip)
    right = chain(half, "BC", "CD", joint("B", 2), joint("C", 3), '<site name="right" pos="{at}"/>')
    return f"""<mujoco>
      <option timestep="{step_s!r}" gravity="0 0 0" integrator="{integrator}" noslip_iterations="{noslip}">
        <flag contact="disable"/>
      </option>
      <worldbody>{left}{right}</worldbody>
      <equality><connect site1="left" site2="right" {CLOSURE[solver].format(**two_steps)}/></equality>
    </mujoco>"""


class Peer:
    """One case under one choice of settings."""

    def __init__(self, case, forces_n, integrator, solver, steps_a_tick=1, noslip=0):
        self.case = case
        step_s = case["step_s"] / steps_a_tick
        self.model = mujoco.MjModel.from_xml_string(xml(case, integrator, solver, step_s, noslip))
        self.data = mujoco.MjData(self.model)
        self.steps_a_tick = steps_a_tick
        # The force acts on a massless body at the tip of arm ED, as a Cartesian force, held over a tick.
        tip = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, "tip")
        control = np.zeros((len(forces_n), self.model.nbody, 6))
        control[:, tip, :2] = forces_n
        control = np.repeat(control.reshape(len(forces_n), -1), steps_a_tick, axis=0)
        copies = -(-LEAST_STEPS // len(control))
        self.control = np.tile(control, (copies, 1, 1))
        self.data.qpos[:] = case["start_rad"]
        mujoco.mj_forward(self.model, self.data)
        full = mujoco.mjtState.mjSTATE_FULLPHYSICS
        self.start = np.zeros(mujoco.mj_stateSize(self.model, full))
        mujoco.mj_getState(self.model, self.data, self.start, full)
        self.start = np.tile(self.start, (copies, 1))
        self.state = np.zeros((*self.control.shape[:2], self.start.shape[1]))

    def roll(self):
        """The whole run, a short one several times over, in one call of MuJoCo's own loop."""
        rollout.rollout(
            self.model, self.data, self.start, self.control,
            control_spec=int(mujoco.mjtState.mjSTATE_XFRC_APPLIED), state=self.state, skip_checks=False,
        )

    def tips_m(self):
        """The tips of ED and of CD, a row a tick."""
        self.roll()
        # Full physics: the time, then the positions.
        every = self.state[0, self.steps_a_tick - 1 :: self.steps_a_tick, 1:5]
        angles = np.vstack([self.case["start_rad"], every])
        half = 0.5 * self.case["base_m"]
        return self._tip(-half, "AE", "ED", angles[:, :2]), self._tip(half, "BC", "CD", angles[:, 2:])

    def _tip(self, x, inner, outer, angles):
        inner, outer = (self.case["arms"][name]["length_m"] for name in (inner, outer))
        first, second = angles[:, 0], angles.sum(axis=1)
        return np.column_stack([
            x + inner * np.cos(first) + outer * np.cos(second),
            inner * np.sin(first) + outer * np.sin(second),
        ])

    def steps_ns(self, runs):
        """The CPU time of a step in each of several whole runs, ns: median and least."""
        each = []
        for _ in range(runs):
            start = time.process_time_ns()
            self.roll()
            each.append((time.process_time_ns() - start) / (self.control.shape[0] * self.control.shape[1]))
        return [float(np.median(each)), min(each)]
