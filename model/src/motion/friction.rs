//! This file says how two coordinates move against up to four dry brakes: the exact solution in finitely many cases.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use nalgebra::{Matrix2, SMatrix, Vector2};

use super::two_coordinate::solve;

/// Sine below which two brakes count as parallel: they hold and release the same motion.
const PARALLEL: f64 = 1e-12;

/// Dry brakes on two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryBrakes {
    /// G, 4×2, rows A, E, B, C: the brakes' rates by the two coordinates' rates.
    pub rows: SMatrix<f64, 4, 2>,
    /// Greatest torque of each brake, N·m, 0 or more; 0 is no brake.
    pub bounds_nm: [f64; 4],
}

/// What the brakes let happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dry {
    /// v: the motion of the two coordinates.
    pub motion: [f64; 2],
    /// λ: the torques of A, E, B, C on their joints, N·m.
    pub torques_nm: [f64; 4],
    /// Which brakes hold their joint.
    pub held: [bool; 4],
}

/// Solves M·v = r + Σ Gᵢᵀ·λᵢ, where λᵢ opposes Gᵢ·v with its bound, or is any torque inside it where Gᵢ·v = 0.
///
/// v is an acceleration from rest (r: the drive) or a velocity after a step (r: momentum and impulse). It is unique:
///
/// 1. v = 0 if and only if −r lies in the zonotope Σ Gᵢᵀ·[−boundᵢ, boundᵢ], a polygon whose sides are parallel to the Gᵢ;
/// 2. else v runs along a direction that one brake, or several parallel ones, holds;
/// 3. else v lies in one of the 2·n sectors between these directions, where every sign is known.
///
/// The first case that is consistent is the answer: bounded work, no iteration. Where rounding leaves none, the one with
/// the smallest contradiction is. The torques at v = 0 are not unique; those that load every brake least by its bound are
/// returned.
pub fn dry_motion(mass: &Matrix2<f64>, drive: &Vector2<f64>, brakes: &DryBrakes) -> Dry {
    let hold = brakes.hold(drive);
    if hold.share <= 1.0 {
        return Dry {
            motion: [0.0; 2],
            torques_nm: hold.torques_nm,
            held: [0, 1, 2, 3].map(|i| brakes.acts(i)),
        };
    }
    let mut best: Option<(f64, Dry)> = None;
    let cases = (0..4).filter(|&i| brakes.acts(i));
    let one_held = cases.clone().map(|i| brakes.along(mass, drive, i));
    let sectors = cases.flat_map(|i| {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(way, side)| brakes.sector(mass, drive, brakes.signs(i, way, side)))
    });
    for (contradiction, dry) in one_held.chain(sectors) {
        if contradiction <= 0.0 {
            return dry;
        }
        if best.is_none_or(|(least, _)| contradiction < least) {
            best = Some((contradiction, dry));
        }
    }
    best.map_or_else(|| brakes.sector(mass, drive, [0.0; 4]).1, |(_, dry)| dry)
}

/// How brakes at rest carry a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// The part of their strength that the brakes need to hold the load; above 1 they cannot.
    pub share: f64,
    /// Torques of A, E, B, C that balance the load, N·m: none of its bound takes more than `share`.
    pub torques_nm: [f64; 4],
}

impl DryBrakes {
    /// How the brakes hold `drive` at rest; `share` is the gauge of their zonotope at −`drive`.
    pub fn hold(&self, drive: &Vector2<f64>) -> Hold {
        let mut share = 0.0;
        let mut normal = Vector2::zeros();
        let acting = (0..4).filter(|&i| self.acts(i));
        // The sides' normals, and the sides' own directions for brakes that are all parallel.
        let directions = acting.flat_map(|i| [quarter_turn(self.row(i)), self.row(i)]);
        for direction in directions {
            let strength = self.strength(&direction);
            let push = direction.dot(drive).abs();
            let needed = if strength > 0.0 {
                push / strength
            } else if push > PARALLEL * direction.norm() * drive.norm() {
                f64::INFINITY
            } else {
                0.0
            };
            if needed > share {
                (share, normal) = (needed, direction);
            }
        }
        if !(0..4).any(|i| self.acts(i)) && *drive != Vector2::zeros() {
            share = f64::INFINITY;
        }
        Hold {
            share,
            torques_nm: self.torques_at_rest(drive, share, normal),
        }
    }

    /// Greatest component of the brakes' torques along a direction, times its length.
    fn strength(&self, along: &Vector2<f64>) -> f64 {
        (0..4)
            .map(|j| self.bounds_nm[j] * self.component(j, along).abs())
            .sum()
    }

    fn torques_at_rest(&self, drive: &Vec2, share: f64, normal: Vec2) -> [f64; 4] {
        let mut torques_nm = [0.0; 4];
        if share == 0.0 || share == f64::INFINITY {
            return torques_nm;
        }
        let side = normal.dot(drive).signum();
        let mut rest = -drive;
        let crossing = |j: &usize| self.component(*j, &normal) != 0.0;
        for j in (0..4).filter(crossing) {
            let sign = self.component(j, &normal).signum();
            torques_nm[j] = -share * self.bounds_nm[j] * side * sign;
            rest -= self.row(j) * torques_nm[j];
        }
        // What is left lies along the side of the polygon and is shared by the brakes parallel to it.
        let along = quarter_turn(normal);
        let parallel = |j: &usize| !crossing(j);
        let strength: f64 = (0..4)
            .filter(parallel)
            .map(|j| self.bounds_nm[j] * self.row(j).dot(&along).abs())
            .sum();
        if strength > 0.0 {
            let part = rest.dot(&along) / strength;
            for j in (0..4).filter(parallel) {
                torques_nm[j] = part * self.bounds_nm[j] * self.row(j).dot(&along).signum();
            }
        }
        torques_nm
    }

    /// The motion that brake `i` and those parallel to it let through, and how far it contradicts their bounds, N·m.
    fn along(&self, mass: &Matrix2<f64>, drive: &Vector2<f64>, i: usize) -> (f64, Dry) {
        let direction = quarter_turn(self.row(i));
        let push = direction.dot(drive);
        let surplus = push.abs() - self.strength(&direction);
        let speed = push.signum() * surplus / direction.dot(&(mass * direction));
        let motion = direction * speed;
        let mut torques_nm = [0.0; 4];
        let mut held = [false; 4];
        let mut needed = mass * motion - drive;
        for j in 0..4 {
            let component = self.component(j, &direction);
            if component == 0.0 {
                held[j] = self.acts(j);
            } else {
                torques_nm[j] = -push.signum() * self.bounds_nm[j] * component.signum();
                needed -= self.row(j) * torques_nm[j];
            }
        }
        let (row, row_length) = (self.row(i), self.row(i).norm());
        let strength: f64 = (0..4)
            .filter(|&j| held[j])
            .map(|j| self.bounds_nm[j] * self.row(j).norm())
            .sum();
        let share = needed.dot(&row) / row_length / strength;
        for j in (0..4).filter(|&j| held[j]) {
            torques_nm[j] = share * self.bounds_nm[j] * self.row(j).dot(&row).signum();
        }
        let contradiction = f64::max(share.abs() - 1.0, -surplus / push.abs());
        let motion = motion.into();
        (
            contradiction,
            Dry {
                motion,
                torques_nm,
                held,
            },
        )
    }

    /// The motion if every brake slips with a given sign, and how far it contradicts these signs, by its speed.
    fn sector(&self, mass: &Matrix2<f64>, drive: &Vector2<f64>, signs: [f64; 4]) -> (f64, Dry) {
        let torques_nm = [0, 1, 2, 3].map(|j| -signs[j] * self.bounds_nm[j]);
        let load: Vec2 = drive + self.rows.transpose() * nalgebra::Vector4::from(torques_nm);
        let motion = solve(mass, &load);
        let contradiction = (0..4)
            .filter(|&j| self.acts(j))
            .map(|j| -signs[j] * self.row(j).dot(&motion) / self.row(j).norm() / motion.norm())
            .fold(f64::NEG_INFINITY, f64::max);
        let dry = Dry {
            motion: motion.into(),
            torques_nm,
            held: [false; 4],
        };
        (contradiction, dry)
    }

    /// The signs of the brakes' rates in the sector on one side of the direction that brake `i` lets through.
    fn signs(&self, i: usize, way: f64, side: f64) -> [f64; 4] {
        let direction = quarter_turn(self.row(i)) * way;
        [0, 1, 2, 3].map(|j| {
            let component = self.component(j, &direction);
            if component == 0.0 {
                side * self.row(j).dot(&self.row(i)).signum()
            } else {
                component.signum()
            }
        })
    }

    /// The component of brake `j` along a direction, times its length; exactly zero where they are at right angles.
    fn component(&self, j: usize, along: &Vector2<f64>) -> f64 {
        let row = self.row(j);
        let component = row.dot(along);
        if component.abs() <= PARALLEL * row.norm() * along.norm() {
            0.0
        } else {
            component
        }
    }

    fn acts(&self, i: usize) -> bool {
        self.bounds_nm[i] > 0.0 && self.row(i) != Vector2::zeros()
    }

    fn row(&self, i: usize) -> Vector2<f64> {
        self.rows.row(i).transpose()
    }
}

type Vec2 = Vector2<f64>;

fn quarter_turn(vector: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}
