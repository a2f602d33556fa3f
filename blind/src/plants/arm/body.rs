//! This file draws an arm: where its joints are, what its links weigh, and what its description says of its friction.

use super::vector::{M, V, seen, turned};
use crate::draw::{Draw, rounded};
use std::f64::consts::{FRAC_PI_2, PI};

/// An arm; every joint turns about, or slides along, the z axis of its own frame.
#[derive(Clone, Debug)]
pub struct Body {
    pub joints: Vec<Member>,
    /// Where a payload is fixed, in the frame of the last link, m.
    pub flange: V,
}

/// A joint and the link that it moves.
#[derive(Clone, Copy, Debug)]
pub struct Member {
    /// Where its frame lies in the one before: place, m, and roll, pitch and yaw.
    pub place: V,
    pub angles: V,
    pub slides: bool,
    /// Its axis points along z, or against it.
    pub sense: f64,
    pub link: Link,
    /// What the description says of its friction: Coulomb and viscous; 0 where it is silent.
    pub dry: f64,
    pub viscous: f64,
}

/// A rigid body as a technician weighs it.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    pub mass: f64,
    /// The centre of its mass, m.
    pub centre: V,
    /// Moments about that centre, kg·m²: xx, xy, xz, yy, yz, zz.
    pub moments: [f64; 6],
}

impl Link {
    /// The matrix of its moments.
    pub const fn tensor(&self) -> M {
        let [xx, xy, xz, yy, yz, zz] = self.moments;
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    /// The same shape of another mass.
    pub fn heavier(&self, more: f64) -> Link {
        let share = 1.0 + more / self.mass;
        Link {
            mass: self.mass * share,
            centre: self.centre,
            moments: self.moments.map(|moment| moment * share),
        }
    }

    /// With a small ball fixed to it at a place.
    pub fn with_ball(&self, mass: f64, at: V) -> Link {
        let whole = self.mass + mass;
        let zip =
            |f: &dyn Fn(f64, f64) -> f64, [a, b, c]: V, [x, y, z]: V| [f(a, x), f(b, y), f(c, z)];
        let centre = zip(&|a, b| (self.mass * a + mass * b) / whole, self.centre, at);
        let moved = |mass: f64, from: V| {
            let [x, y, z] = zip(&|a, b| a - b, from, centre);
            [
                mass * (y * y + z * z),
                -mass * x * y,
                -mass * x * z,
                mass * (x * x + z * z),
                -mass * y * z,
                mass * (x * x + y * y),
            ]
        };
        let (own, ball) = (moved(self.mass, self.centre), moved(mass, at));
        let mut moments = self.moments;
        for ((slot, a), b) in moments.iter_mut().zip(own).zip(ball) {
            *slot += a + b;
        }
        Link {
            mass: whole,
            centre,
            moments,
        }
    }
}

impl Body {
    /// An arm of two to five joints; the description of a share of all arms states friction.
    pub fn draw(draw: &mut Draw) -> Body {
        let count = 2 + draw.below(4);
        let size = draw.log_uniform(0.5, 1.2);
        let heavy = draw.log_uniform(0.8, 4.0) * size * size;
        let joints: Vec<Member> = (0..count)
            .map(|k| member(k, count, size, heavy, draw))
            .collect();
        Body {
            flange: [0.0, 0.0, rounded(size * draw.uniform(0.08, 0.2))],
            joints,
        }
    }
}

fn member(k: usize, count: usize, size: f64, heavy: f64, draw: &mut Draw) -> Member {
    let outward = 1.0 - 0.75 * k as f64 / count as f64;
    let long = size * outward * draw.uniform(0.2, 0.45);
    let quarter = |draw: &mut Draw| draw.pick(&[-FRAC_PI_2, 0.0, FRAC_PI_2, 0.0]);
    let tilts = draw.chance(0.3);
    let angles = match k {
        0 => [0.0, 0.0, draw.uniform(-PI, PI)],
        // Parallel to the one before, or across it.
        _ => [
            quarter(draw),
            if tilts { draw.uniform(-0.6, 0.6) } else { 0.0 },
            quarter(draw),
        ],
    };
    // A first joint that lies sees weight; one that stands does not.
    let angles = match k == 0 && draw.chance(0.5) {
        true => [FRAC_PI_2, 0.0, 0.0],
        false => angles,
    };
    let place = match draw.below(3) {
        0 => [long, 0.0, 0.0],
        1 => [0.0, long, 0.1 * long],
        _ => [0.1 * long, 0.0, long],
    };
    Member {
        place: place.map(rounded),
        angles: angles.map(|angle| rounded(angle * 1e3) / 1e3),
        slides: k > 0 && draw.chance(0.12),
        sense: if draw.chance(0.2) { -1.0 } else { 1.0 },
        link: link(long, heavy * outward * outward, draw),
        dry: 0.0,
        viscous: 0.0,
    }
}

/// A box turned somehow: moments that a body can have.
fn link(long: f64, mass: f64, draw: &mut Draw) -> Link {
    let mass = rounded(mass * draw.uniform(0.6, 1.4));
    let along = draw.below(3);
    let mut sides = [0; 3].map(|_: i32| long * draw.uniform(0.25, 0.5));
    if let Some(side) = sides.get_mut(along) {
        *side = long * draw.uniform(0.8, 1.2);
    }
    let [a, b, c] = sides;
    let own = [
        [mass / 12.0 * (b * b + c * c), 0.0, 0.0],
        [0.0, mass / 12.0 * (a * a + c * c), 0.0],
        [0.0, 0.0, mass / 12.0 * (a * a + b * b)],
    ];
    let tilt = [0; 3].map(|_: i32| draw.uniform(-0.4, 0.4));
    let [[xx, xy, xz], [_, yy, yz], [.., zz]] = seen(&turned(tilt), &own);
    let centre = [0; 3].map(|_: i32| long * draw.uniform(-0.12, 0.12));
    let mut centre = centre.map(rounded);
    if let Some(slot) = centre.get_mut(along) {
        *slot = rounded(draw.sign() * long * draw.uniform(0.25, 0.55));
    }
    let exact = |x: f64| format!("{x:.5e}").parse().unwrap_or(x);
    Link {
        mass,
        centre,
        moments: [xx, xy, xz, yy, yz, zz].map(exact),
    }
}
