//! This file is the axis: one driven joint, `inertia·q̈ = gain·u − Σ resistance`, with dry friction as a set.
//!
//! In motion the sense is fixed over a step and the smooth equations are integrated by the classical
//! Runge-Kutta rule; the instant of a stop is located inside the step, and at rest the joint stays stuck for
//! as long as the applied effort lies between the two breakaway levels.

mod transmission;

use crate::effects::{Instant, Law};
pub use transmission::{TRAILING_PARTS, Trailing, Transmission};

/// One driven joint. Travel in m (N, kg) or rad (N·m, kg·m²).
pub struct Axis {
    /// Mass or moment of inertia.
    pub inertia: f64,
    /// The resistance laws that act together.
    pub laws: Vec<Box<dyn Law>>,
    /// What the joint does with the effort that it transmits.
    pub transmission: Transmission,
}

/// The most laws that can act together.
pub const MOST_LAWS: usize = 16;

/// The state of an axis: position, speed, and one memory for each law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Time since the first sample, s.
    pub time_s: f64,
    /// Position, m or rad.
    pub position: f64,
    /// Speed, m/s or rad/s; exactly 0 while stuck.
    pub speed: f64,
    /// The memory of each law, in the order of `Axis::laws`.
    pub memory: [f64; MOST_LAWS],
    /// Displacement of each trailing part from the joint, m or rad, and its rate.
    pub trailing: [[f64; 2]; TRAILING_PARTS],
}

/// Longest integration step of a joint with trailing parts, rad of their oscillation.
const STEP_RAD: f64 = 0.5;
/// Stops that one step may contain before the rest of the step is taken as stuck.
const STOPS_A_STEP: usize = 4;
/// Longest step in which trailing parts swing while the joint stands, rad of their oscillation.
const RING_RAD: f64 = 0.05;
/// Halvings used to locate a stop inside a step: to one part in 2^20 of the step.
const STOP_HALVINGS: usize = 20;

impl Axis {
    /// The state at this position and speed with every law's memory as before any motion.
    pub fn state(&self, time_s: f64, position: f64, speed: f64) -> State {
        let mut memory = [0.0; MOST_LAWS];
        for (memory, law) in memory.iter_mut().zip(&self.laws) {
            *memory = law.starts_with();
        }
        State {
            time_s,
            position,
            speed,
            memory,
            trailing: [[0.0; 2]; TRAILING_PARTS],
        }
    }

    /// Advances the state by `step_s` under a driving effort that goes linearly from `effort` to `effort_end`.
    pub fn step(&self, state: &mut State, effort: f64, effort_end: f64, step_s: f64) {
        let stiffest = self.parts().flatten().map(|part| part.resonance_rad_s);
        let stiffest = stiffest.fold(0.0, f64::max);
        let count = (stiffest * step_s / STEP_RAD).ceil();
        if count <= 1.0 {
            return self.step_once(state, effort, effort_end, step_s);
        }
        let slope = (effort_end - effort) / count;
        for part in 0..count as usize {
            let begin = effort + slope * part as f64;
            self.step_once(state, begin, begin + slope, step_s / count);
        }
    }

    /// One integration step.
    fn step_once(&self, state: &mut State, effort: f64, effort_end: f64, step_s: f64) {
        let slope = (effort_end - effort) / step_s;
        let mut done_s = 0.0;
        for _ in 0..STOPS_A_STEP {
            let left_s = step_s - done_s;
            if left_s <= 0.0 {
                return;
            }
            let begin = effort + slope * done_s;
            let sense = self.sense(state, begin, begin + slope * left_s);
            if sense == 0.0 {
                break;
            }
            let mut next = self.slide(state, sense, begin, slope, left_s);
            if next.speed * sense >= 0.0 {
                *state = next;
                return;
            }
            let slid_s = self.locate_stop(state, sense, begin, slope, left_s);
            next = self.slide(state, sense, begin, slope, slid_s);
            next.speed = 0.0;
            done_s += slid_s;
            *state = next;
        }
        state.time_s += step_s - done_s;
        self.ring(state, step_s - done_s);
    }

    /// Lets the trailing parts swing while the joint stands.
    fn ring(&self, state: &mut State, left_s: f64) {
        for (part, moved) in self.parts().zip(&mut state.trailing) {
            let Some(part) = part else {
                continue;
            };
            let steps = (left_s * part.resonance_rad_s / RING_RAD).ceil().max(1.0);
            let step_s = left_s / steps;
            for _ in 0..steps as usize {
                moved[1] += step_s * part.pull(*moved);
                moved[0] += step_s * moved[1];
            }
        }
    }

    fn parts(&self) -> impl Iterator<Item = Option<Trailing>> {
        self.transmission.trailing.into_iter()
    }

    /// The effort with which the trailing parts hold the joint back.
    fn held_back(&self, state: &State) -> f64 {
        let each = self.parts().zip(state.trailing);
        let held = each.filter_map(|(part, moved)| Some(part?.share * part?.pull(moved)));
        self.inertia * held.sum::<f64>()
    }

    /// The sense in which the joint moves next: that of its speed, or at rest that of an effort which breaks it
    /// loose now or before the end of the step, or 0.
    fn sense(&self, state: &State, effort: f64, effort_end: f64) -> f64 {
        if state.speed != 0.0 {
            return state.speed.signum();
        }
        for applied in [effort, effort_end] {
            for sense in [1.0, -1.0] {
                let now = instant(state, sense);
                let net = applied - self.smooth(&now, &state.memory) - self.held_back(state);
                if net * sense > self.dry(&now, applied) {
                    return sense;
                }
            }
        }
        0.0
    }

    fn locate_stop(&self, state: &State, sense: f64, effort: f64, slope: f64, step_s: f64) -> f64 {
        let (mut low_s, mut high_s) = (0.0, step_s);
        for _ in 0..STOP_HALVINGS {
            let middle_s = 0.5 * (low_s + high_s);
            let speed = self.slide(state, sense, effort, slope, middle_s).speed;
            if speed * sense >= 0.0 {
                low_s = middle_s;
            } else {
                high_s = middle_s;
            }
        }
        high_s
    }

    /// One Runge-Kutta step with the sense of motion held.
    fn slide(&self, from: &State, sense: f64, effort: f64, slope: f64, step_s: f64) -> State {
        let from = &self.begun(from, sense);
        let memories = self.memories();
        let rate =
            |at: &State, after_s: f64| self.rate(at, sense, effort + slope * after_s, memories);
        let half_s = 0.5 * step_s;
        let (mut to, mut at) = (*from, *from);
        let mut k = rate(from, 0.0);
        to.advance(&k, step_s / 6.0, memories);
        for (after_s, made_s) in [
            (half_s, step_s / 3.0),
            (half_s, step_s / 3.0),
            (step_s, step_s / 6.0),
        ] {
            at.place(from, &k, after_s, memories);
            k = rate(&at, after_s);
            to.advance(&k, made_s, memories);
        }
        to
    }

    /// The state with the memories that a new sense of motion begins anew.
    fn begun(&self, from: &State, sense: f64) -> State {
        let mut state = *from;
        let own = state.memory.iter_mut().zip(&self.laws);
        for (memory, law) in own.filter(|(_, law)| law.begins_anew()) {
            *memory = law.memory_after(*memory, 0.0, sense);
        }
        state
    }

    /// How many memories move: up to that of the last law that has one.
    fn memories(&self) -> usize {
        let last = self.laws.iter().rposition(|law| law.remembers());
        last.map_or(0, |last| last + 1)
    }

    /// The time derivative of the state, in the state's own fields.
    fn rate(&self, at: &State, sense: f64, effort: f64, memories: usize) -> State {
        let now = instant(at, sense);
        let resistance = self.smooth(&now, &at.memory) + self.dry(&now, effort) * sense;
        let mut memory = [0.0; MOST_LAWS];
        let moving = memory.iter_mut().zip(&self.laws).zip(&at.memory);
        for ((rate, law), &memory) in moving.take(memories) {
            *rate = law.memory_rate(&now, memory);
        }
        let net = effort - resistance - self.held_back(at);
        let apart: f64 = self.parts().flatten().map(|part| part.share).sum();
        let acceleration = net / (self.inertia * (1.0 - apart));
        let mut trailing = [[0.0; 2]; TRAILING_PARTS];
        for ((part, moved), rate) in self.parts().zip(at.trailing).zip(&mut trailing) {
            if let Some(part) = part {
                *rate = [moved[1], part.pull(moved) - acceleration];
            }
        }
        State {
            time_s: 1.0,
            position: at.speed,
            speed: acceleration,
            memory,
            trailing,
        }
    }

    fn smooth(&self, now: &Instant, memory: &[f64]) -> f64 {
        let each = self.laws.iter().zip(memory);
        each.map(|(law, &memory)| law.smooth(now, memory)).sum()
    }

    /// The dry level in this sense under a driving effort; a negative sum (only possible with odd parameters) holds nothing.
    fn dry(&self, now: &Instant, effort: f64) -> f64 {
        let of_laws = self.laws.iter().map(|law| law.dry(now)).sum::<f64>();
        (of_laws + self.transmission.friction(effort)).max(0.0)
    }
}

fn instant(state: &State, sense: f64) -> Instant {
    Instant {
        time_s: state.time_s,
        position: state.position,
        speed: state.speed,
        sense,
    }
}

impl State {
    /// Moves along `rate` for `step_s`; the memories from `memories` on stay.
    fn advance(&mut self, rate: &State, step_s: f64, memories: usize) {
        self.time_s += step_s * rate.time_s;
        self.position += step_s * rate.position;
        self.speed += step_s * rate.speed;
        let moving = self.memory.iter_mut().zip(&rate.memory);
        for (memory, rate) in moving.take(memories) {
            *memory += step_s * rate;
        }
        let own = self.trailing.iter_mut().flatten();
        for (own, rate) in own.zip(rate.trailing.iter().flatten()) {
            *own += step_s * rate;
        }
    }

    /// Becomes the state that lies `step_s` along `rate` from another.
    fn place(&mut self, from: &State, rate: &State, step_s: f64, memories: usize) {
        self.time_s = from.time_s + step_s * rate.time_s;
        self.position = from.position + step_s * rate.position;
        self.speed = from.speed + step_s * rate.speed;
        let moving = self.memory.iter_mut().zip(&from.memory).zip(&rate.memory);
        for ((memory, from), rate) in moving.take(memories) {
            *memory = from + step_s * rate;
        }
        let moving = from.trailing.iter().zip(&rate.trailing);
        let moving = moving.flat_map(|(from, rate)| from.iter().zip(rate));
        for (own, (from, rate)) in self.trailing.iter_mut().flatten().zip(moving) {
            *own = from + step_s * rate;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::law;
    use rigproof_spec::effect::Mechanism;

    fn axis(parameters: &[(Mechanism, &[f64])]) -> Axis {
        Axis {
            inertia: 1.3,
            laws: parameters
                .iter()
                .map(|(mechanism, values)| law(*mechanism, values).unwrap())
                .collect(),
            transmission: Transmission::default(),
        }
    }

    #[test]
    fn a_joint_under_less_than_the_breakaway_level_does_not_creep() {
        let axis = axis(&[(Mechanism::DryOffset, &[0.7]), (Mechanism::Viscous, &[0.2])]);
        let mut state = axis.state(0.0, 0.11, 0.0);
        for _ in 0..10_000 {
            axis.step(&mut state, 0.69, 0.69, 1e-3);
        }
        assert_eq!((state.position, state.speed), (0.11, 0.0));
    }

    #[test]
    fn a_sliding_joint_stops_where_energy_says() {
        let axis = axis(&[(Mechanism::DryOffset, &[0.7])]);
        let mut state = axis.state(0.0, 0.0, 0.9);
        for _ in 0..3000 {
            axis.step(&mut state, 0.0, 0.0, 1e-3);
        }
        assert_eq!(state.speed, 0.0);
        assert!((state.position - 0.5 * 1.3 * 0.81 / 0.7).abs() < 1e-9);
    }

    #[test]
    fn friction_that_overshoots_takes_more_after_a_reversal_only() {
        let axis = axis(&[
            (Mechanism::DryOffset, &[0.7]),
            (Mechanism::FrictionOvershoot, &[0.4, 0.05]),
        ]);
        // How far 0.9 m/s carry it: on its first way, and after it has turned back.
        let mut state = axis.state(0.0, 0.0, 0.9);
        let way = |state: &mut State| {
            let begun = state.position;
            for _ in 0..3000 {
                axis.step(state, 0.0, 0.0, 1e-3);
            }
            (state.position - begun).abs()
        };
        let first = way(&mut state);
        state.speed = -0.9;
        let second = way(&mut state);
        // The work of the overshoot, 0.4·0.05 N·m over the second way, is friction's that is not needed any more.
        let energy = 0.5 * 1.3 * 0.81;
        assert!((first - energy / 0.7).abs() < 1e-6, "{first}");
        assert!(
            (second - (energy - 0.4 * 0.05) / 0.7).abs() < 1e-4,
            "{second}"
        );
    }

    #[test]
    fn asymmetric_breakaway_levels_differ_with_the_sense() {
        let axis = axis(&[
            (Mechanism::DryOffset, &[0.7]),
            (Mechanism::DirectionAsymmetry, &[0.0, 0.15]),
        ]);
        for (effort, moves) in [(0.8, false), (0.9, true), (-0.5, false), (-0.6, true)] {
            let mut state = axis.state(0.0, 0.0, 0.0);
            axis.step(&mut state, effort, effort, 1e-3);
            assert_eq!(state.speed != 0.0, moves, "effort {effort}");
        }
    }

    #[test]
    fn friction_by_the_effort_lets_a_worm_drive_push_itself_only_so_far() {
        let mut axis = axis(&[(Mechanism::Viscous, &[0.7])]);
        axis.transmission.friction_share = 0.37;
        let mut state = axis.state(0.0, 0.0, 0.0);
        for _ in 0..40_000 {
            axis.step(&mut state, 1.9, 1.9, 1e-3);
        }
        // In steady motion the drag takes what friction leaves of the drive.
        assert!((state.speed - 1.9 * (1.0 - 0.37) / 0.7).abs() < 1e-6);
        axis.step(&mut state, 0.0, 0.0, 1e-9);
        let slowing = axis.rate(&state, 1.0, 0.0, 0).speed;
        assert!((slowing + 0.7 * state.speed / 1.3).abs() < 1e-9);
    }

    #[test]
    fn parts_behind_a_spring_move_momentum_and_never_make_it() {
        let mut axis = axis(&[]);
        let trailing = Trailing {
            share: 0.31,
            resonance_rad_s: 47.0,
            damping: 0.08,
            half_gap: 0.0,
        };
        axis.transmission.trailing[0] = Some(trailing);
        let mut state = axis.state(0.0, 0.0, 0.0);
        for _ in 0..3000 {
            axis.step(&mut state, 0.9, 0.9, 1e-3);
        }
        let [displacement, rate] = state.trailing[0];
        let momentum = 1.3 * state.speed + 1.3 * 0.31 * rate;
        assert!((momentum - 0.9 * 3.0).abs() < 1e-9, "{momentum}");
        // In the end everything accelerates together, the spring stretched by what its part weighs.
        let acceleration = 0.9 / 1.3;
        let stretched = -acceleration / (47.0 * 47.0);
        assert!((displacement - stretched).abs() < 1e-5 * stretched.abs());
    }

    #[test]
    fn a_part_in_a_gap_is_free_until_an_end_of_it_pushes() {
        let mut axis = axis(&[]);
        let (share, gap, step_s) = (0.37, 0.02, 1e-3);
        axis.transmission.trailing[1] = Some(Trailing::in_a_gap(share, gap));
        let mut state = axis.state(0.0, 0.0, 0.0);
        // In the gap the joint is lighter by the part.
        for _ in 0..50 {
            axis.step(&mut state, 0.9, 0.9, step_s);
        }
        let alone = 0.9 * 0.05 / (1.3 * (1.0 - share));
        assert!((state.speed - alone).abs() < 1e-12, "{}", state.speed);
        let mut energy = 0.0;
        for _ in 0..1950 {
            axis.step(&mut state, 0.9, 0.9, step_s);
        }
        let momentum = |state: &State| 1.3 * (state.speed + share * state.trailing[1][1]);
        assert!((momentum(&state) - 0.9 * 2.0).abs() < 1e-9);
        // Pushed together, the part stands at the rear end of the gap.
        assert!((state.trailing[1][0] + 0.5 * gap).abs() < 0.02 * gap);
        assert!((state.speed - 0.9 * 2.0 / 1.3).abs() < 1e-3);
        // Braked, the part flies on at its speed to the front end, and no energy is made.
        let flown = state.speed + state.trailing[1][1];
        for k in 0..100 {
            axis.step(&mut state, -0.2, -0.2, step_s);
            let [displacement, rate] = state.trailing[1];
            if k > 5 && displacement < 0.5 * gap {
                assert!((state.speed + rate - flown).abs() < 1e-3, "{k}");
            }
            let part = state.speed + rate;
            let now = (1.0 - share) * state.speed.powi(2) + share * part.powi(2);
            assert!(k == 0 || now <= energy, "{k}: {now} > {energy}");
            energy = now;
        }
    }

    #[test]
    fn halving_the_step_changes_a_stick_slip_run_very_little() {
        let run = |divisions: usize| {
            let axis = axis(&[
                (Mechanism::DryOffset, &[0.4]),
                (Mechanism::Presliding, &[0.3, 0.002]),
                (Mechanism::Viscous, &[0.11]),
            ]);
            let mut state = axis.state(0.0, 0.0, 0.0);
            let step_s = 1e-3 / divisions as f64;
            for k in 0..4000 * divisions {
                let effort = 1.9 * libm::sin(2.3 * k as f64 * step_s);
                let end = 1.9 * libm::sin(2.3 * (k + 1) as f64 * step_s);
                axis.step(&mut state, effort, end, step_s);
            }
            state.position
        };
        assert!((run(1) - run(2)).abs() < 1e-6, "{}", run(1) - run(2));
    }
}
