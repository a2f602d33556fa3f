//! This file says what efforts a motion of an arm takes, by virtual power: each link's force and moment, times what it moves for a unit of each joint's speed.

use super::body::{Body, Member};
use super::vector::{M, NO_TURN, V, ZERO, about_z, cross, dot, plus, product, seen, times, turned};

/// Free fall, m/s².
pub const FREE_FALL: V = [0.0, 0.0, -9.81];

/// A joint's axis in the frame of the base at one instant.
#[derive(Clone, Copy)]
struct Axis {
    slides: bool,
    direction: V,
    /// The rate at which the direction turns away.
    direction_rate: V,
    origin: V,
    origin_rate: V,
    speed: f64,
    acceleration: f64,
}

impl Axis {
    /// What a point and a turning body get from a unit of this joint's speed.
    fn gives(&self, point: V) -> (V, V) {
        match self.slides {
            true => (self.direction, ZERO),
            false => (
                cross(self.direction, plus(point, -1.0, self.origin)),
                self.direction,
            ),
        }
    }

    /// The rates of both.
    fn rates(&self, point: V, point_rate: V) -> (V, V) {
        if self.slides {
            return (self.direction_rate, ZERO);
        }
        let arm = plus(point, -1.0, self.origin);
        let arm_rate = plus(point_rate, -1.0, self.origin_rate);
        let turned = cross(self.direction_rate, arm);
        (
            plus(turned, 1.0, cross(self.direction, arm_rate)),
            self.direction_rate,
        )
    }
}

/// Velocity of a point and rate of turning of the body behind some joints.
fn velocity(axes: &[Axis], point: V) -> (V, V) {
    axes.iter().fold((ZERO, ZERO), |(v, w), axis| {
        let (of_point, of_turn) = axis.gives(point);
        (plus(v, axis.speed, of_point), plus(w, axis.speed, of_turn))
    })
}

/// Acceleration of a point and of turning.
fn acceleration(axes: &[Axis], point: V) -> (V, V) {
    let (point_rate, _) = velocity(axes, point);
    axes.iter().fold((ZERO, ZERO), |(a, b), axis| {
        let (point_gives, turn_gives) = axis.gives(point);
        let (point_rates, turn_rates) = axis.rates(point, point_rate);
        (
            plus(
                plus(a, axis.acceleration, point_gives),
                axis.speed,
                point_rates,
            ),
            plus(
                plus(b, axis.acceleration, turn_gives),
                axis.speed,
                turn_rates,
            ),
        )
    })
}

/// Where a joint stands and how it moves: position, speed and acceleration.
pub type State = [f64; 3];

/// The efforts of the joints, N·m or N, without friction.
pub fn efforts(body: &Body, states: &[State]) -> Vec<f64> {
    let mut axes: Vec<Axis> = Vec::new();
    let (mut turn, mut origin) = (NO_TURN, ZERO);
    let mut efforts = vec![0.0; body.joints.len()];
    for (member, state) in body.joints.iter().zip(states) {
        let (axis, next) = stepped(member, *state, (&turn, origin), &axes);
        axes.push(axis);
        (turn, origin) = next;
        let link = &member.link;
        let centre = plus(origin, 1.0, times(&turn, link.centre));
        let (_, w) = velocity(&axes, centre);
        let (a, b) = acceleration(&axes, centre);
        let force = plus(a, -1.0, FREE_FALL).map(|x| link.mass * x);
        let tensor = seen(&turn, &link.tensor());
        let moment = plus(times(&tensor, b), 1.0, cross(w, times(&tensor, w)));
        for (effort, axis) in efforts.iter_mut().zip(&axes) {
            let (of_point, of_turn) = axis.gives(centre);
            *effort += dot(of_point, force) + dot(of_turn, moment);
        }
    }
    efforts
}

/// The next joint's axis, and the frame behind it.
fn stepped(
    member: &Member,
    [q, speed, acceleration]: State,
    (turn, origin): (&M, V),
    axes: &[Axis],
) -> (Axis, (M, V)) {
    let frame = product(turn, &turned(member.angles));
    let direction = times(&frame, [0.0, 0.0, member.sense]);
    let place = plus(origin, 1.0, times(turn, member.place));
    let (origin_rate, carried) = velocity(axes, place);
    let axis = Axis {
        slides: member.slides,
        direction,
        direction_rate: cross(carried, direction),
        origin: place,
        origin_rate,
        speed,
        acceleration,
    };
    let next = match member.slides {
        true => (frame, plus(place, q, direction)),
        false => (product(&frame, &about_z(member.sense * q)), place),
    };
    (axis, next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;
    use crate::plant::Plant;

    /// The energy of an arm, from the velocities alone.
    fn energy(body: &Body, states: &[State]) -> f64 {
        let mut axes: Vec<Axis> = Vec::new();
        let (mut turn, mut origin) = (NO_TURN, ZERO);
        let mut sum = 0.0;
        for (member, state) in body.joints.iter().zip(states) {
            let (axis, next) = stepped(member, *state, (&turn, origin), &axes);
            axes.push(axis);
            (turn, origin) = next;
            let link = &member.link;
            let centre = plus(origin, 1.0, times(&turn, link.centre));
            let (v, w) = velocity(&axes, centre);
            let tensor = seen(&turn, &link.tensor());
            sum += 0.5 * link.mass * dot(v, v) + 0.5 * dot(w, times(&tensor, w))
                - link.mass * dot(FREE_FALL, centre);
        }
        sum
    }

    #[test]
    fn what_the_efforts_give_is_what_the_energy_gains() {
        for seed in 0..12 {
            let body = Body::draw(&mut Draw::new(Plant::Chain, seed, "a test"));
            let at = |time_s: f64| -> Vec<State> {
                let each = (0..body.joints.len()).map(|k| {
                    let (rate, phase) = (1.3 + 0.4 * k as f64, 0.7 * k as f64 - 0.2);
                    let (s, c) = libm::sincos(rate * time_s + phase);
                    [0.6 * s, 0.6 * rate * c, -0.6 * rate * rate * s]
                });
                each.collect()
            };
            let (now_s, step_s) = (0.83, 1e-5);
            let gained = (energy(&body, &at(now_s + step_s)) - energy(&body, &at(now_s - step_s)))
                / (2.0 * step_s);
            let states = at(now_s);
            let given: f64 = efforts(&body, &states)
                .iter()
                .zip(&states)
                .map(|(effort, [_, speed, _])| effort * speed)
                .sum();
            assert!(
                (gained - given).abs() < 1e-6 * (1.0 + given.abs()),
                "{seed}: {gained} {given}"
            );
        }
    }

    #[test]
    fn a_ball_on_a_rod_hangs_and_swings() {
        let mut body = Body::draw(&mut Draw::new(Plant::Chain, 3, "a test"));
        body.joints.truncate(1);
        let member = &mut body.joints[0];
        member.angles = [core::f64::consts::FRAC_PI_2, 0.0, 0.0];
        (member.sense, member.slides) = (1.0, false);
        member.link.mass = 1.7;
        member.link.centre = [0.3, 0.0, 0.0];
        member.link.moments = [0.0; 6];
        // The axis points along −y of the base: turning lifts the ball.
        let [effort] = efforts(&body, &[[0.4, 2.0, 3.1]])[..] else {
            panic!("one joint");
        };
        let by_hand = 1.7 * 0.3 * 0.3 * 3.1 + 1.7 * 9.81 * 0.3 * libm::cos(0.4);
        assert!((effort - by_hand).abs() < 1e-12, "{effort} {by_hand}");
    }
}
