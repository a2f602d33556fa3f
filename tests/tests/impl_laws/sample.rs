//! This file draws ticks: poses, motions, pushes, paths, laws and settings, many of them where a decision turns.

use core::f64::consts::PI;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rigproof_certify::built_in::Kind;
use rigproof_certify::declared::Solid;
use rigproof_certify::differential::both::{reference_distance_m, reference_rows, reference_tip};
use rigproof_certify::differential::tick::{PathKind, Tick};
use rigproof_model::linkage::forward;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;

/// Draws ticks from a seed.
pub struct Sampler(Pcg64Mcg);

impl Sampler {
    pub fn new(seed: u64) -> Sampler {
        Sampler(Pcg64Mcg::seed_from_u64(seed))
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// From one decade to another, each as often.
    fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        libm::exp10(self.between(low, high))
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.0.random_range(0..count) == 0
    }

    fn polar(&mut self, length: f64) -> [f64; 2] {
        let (sine, cosine) = libm::sincos(self.between(-PI, PI));
        [length * cosine, length * sine]
    }

    fn pick<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.0.random_range(0..all.len())].clone()
    }

    /// A tick as it may come on a rig: table 4.1 or arms of the same order of size, a hand's speed and force, a path within reach.
    pub fn plain(&mut self) -> Tick {
        let layout = self.pick(&[Layout::ThreeBrake, Layout::FourBrake]);
        let mut lengths = arms(layout);
        if self.one_in(3) {
            lengths = Arms {
                l_ae_m: self.between(0.11, 0.73),
                l_ed_m: self.between(0.11, 0.73),
                l_bc_m: self.between(0.11, 0.73),
                l_cd_m: self.between(0.11, 0.73),
                l_ab_m: self.between(0.0, 0.43),
            };
        }
        let base_rad = self.base_rad(&lengths);
        let boundary_m = self.magnitude(-3.1, -0.3);
        let speed_m_s = self.magnitude(-3.7, 0.2);
        let push_n = self.magnitude(-1.3, 1.9);
        Tick {
            layout,
            arms: lengths,
            limit_n: if self.one_in(3) {
                self.between(1.3, 97.0)
            } else {
                greatest_desired_force_n(layout)
            },
            base_rad,
            velocity_m_s: self.polar(speed_m_s),
            force_n: self.polar(push_n),
            path: self.path(),
            boundary_m,
            law: self.law(boundary_m),
            obstacle: if self.one_in(8) {
                Some(if self.one_in(2) {
                    Solid::Left
                } else {
                    Solid::Right
                })
            } else {
                None
            },
        }
    }

    /// Base angles, rad, at which the arms mostly close.
    fn base_rad(&mut self, lengths: &Arms) -> [f64; 2] {
        let mut base_rad = [0.0; 2];
        for _ in 0..6 {
            base_rad = [self.between(0.18, 3.17), self.between(-0.07, 2.99)];
            if forward::pose(lengths, base_rad[0], base_rad[1]).is_ok() {
                break;
            }
        }
        base_rad
    }

    fn point(&mut self) -> [f64; 2] {
        [self.between(-0.47, 0.53), self.between(0.03, 0.67)]
    }

    fn path(&mut self) -> PathKind {
        match self.0.random_range(0..32_u32) {
            0..14 => PathKind::Line([self.point(), self.point()]),
            14..24 => {
                let sweep_rad = if self.one_in(4) {
                    2.0 * PI
                } else {
                    self.between(0.07, 6.21)
                };
                let sweep_rad = if self.one_in(2) {
                    sweep_rad
                } else {
                    -sweep_rad
                };
                let radius_m = self.between(0.013, 0.41);
                PathKind::Arc(self.point(), [radius_m, self.between(-PI, PI), sweep_rad])
            }
            24..31 => {
                let closed = self.one_in(2);
                PathKind::Polyline(self.points(), closed)
            }
            _ => PathKind::Spline(self.points()),
        }
    }

    fn points(&mut self) -> Vec<[f64; 2]> {
        let count = self.0.random_range(3..7);
        (0..count).map(|_| self.point()).collect()
    }

    fn law(&mut self, boundary_m: f64) -> Kind {
        match self.0.random_range(0..32_u32) {
            0 => Kind::Uncontrolled,
            1..11 => Kind::Sdof {
                gap_m: if self.one_in(2) {
                    0.0
                } else {
                    self.between(0.0, boundary_m)
                },
            },
            11..21 => Kind::Proportional {
                gain_n_s_per_m: self.magnitude(0.3, 5.9),
            },
            21..26 => Kind::VelocityRatio {
                gain_nm_s_per_rad: self.magnitude(-1.3, 3.1),
            },
            26..31 => {
                let [stiffness, across, along] = [1.1, 0.3, 0.1].map(|low| {
                    if self.one_in(4) {
                        0.0
                    } else {
                        self.magnitude(low, low + 2.3)
                    }
                });
                Kind::Impedance {
                    stiffness_n_per_m: stiffness,
                    damping_across_n_s_per_m: across,
                    damping_along_n_s_per_m: along,
                }
            }
            _ => Kind::Optimal {
                weight_angle: self.magnitude(-1.1, 1.1),
                weight_energy: self.magnitude(-2.3, 0.7),
                horizon_s: self.magnitude(-3.3, -0.9),
            },
        }
    }

    /// A tick where something is zero, exactly across, on the path, at a corner, extreme or undefined.
    pub fn adverse(&mut self) -> Tick {
        let mut tick = self.plain();
        for _ in 0..self.0.random_range(1..3_u32) {
            match self.0.random_range(0..9_u32) {
                0 => tick.velocity_m_s = self.extreme(),
                1 => tick.force_n = self.extreme(),
                2 => tick.base_rad = [self.angle(), self.angle()],
                3 => self.at_rest(&mut tick),
                4 => self.on_path(&mut tick),
                5 => self.along_axes(&mut tick),
                6 => self.near_singular(&mut tick),
                7 => self.at_reach(&mut tick),
                _ => self.mirrored(&mut tick),
            }
        }
        tick
    }

    fn extreme(&mut self) -> [f64; 2] {
        let all = [
            0.0,
            -0.0,
            5e-324,
            -3e-310,
            2.3e-162,
            1e-9,
            -1.0,
            0.37,
            1e6,
            -1.000_001e6,
            3e154,
            f64::MAX,
            f64::INFINITY,
            f64::NAN,
        ];
        let usual = [0.0, -0.0, -1.0, 0.37];
        let [first, second] = [self.pick(&all), self.pick(&usual)];
        if self.one_in(2) {
            [first, second]
        } else {
            [second, first]
        }
    }

    fn angle(&mut self) -> f64 {
        let all = [
            0.0,
            0.25 * PI,
            0.5 * PI,
            PI,
            -0.5 * PI,
            27.3,
            2.07,
            f64::NAN,
            f64::INFINITY,
        ];
        self.pick(&all)
    }

    /// The tip moves so that one joint stands: along the arm on which the tip then turns.
    fn at_rest(&mut self, tick: &mut Tick) {
        let Some(rows) = reference_rows(tick) else {
            return;
        };
        let row = self.pick(&rows);
        let length = self.magnitude(-2.3, 0.1);
        tick.velocity_m_s = [-length * row.y, length * row.x];
    }

    /// The path goes through the tip, or has a corner there, or the gap or the boundary ends there.
    fn on_path(&mut self, tick: &mut Tick) {
        let Some(tip_m) = reference_tip(tick) else {
            return;
        };
        match &mut tick.path {
            PathKind::Line([from_m, _]) => *from_m = tip_m,
            PathKind::Arc(centre_m, [radius_m, ..]) => {
                let [x, y] = tip_m;
                *centre_m = match self.0.random_range(0..3_u32) {
                    0 => tip_m,
                    1 => [x - *radius_m, y],
                    _ => [x, y + *radius_m],
                };
            }
            PathKind::Polyline(points, _) | PathKind::Spline(points) => {
                let place = self.0.random_range(0..points.len());
                points[place] = tip_m;
            }
        }
    }

    /// Line, push and motion along the axes, so that products are exactly zero.
    fn along_axes(&mut self, tick: &mut Tick) {
        let axes = [[0.0, 0.7], [0.7, 0.0], [-0.7, 0.0], [0.0, -0.7]];
        let [dx, dy] = self.pick(&axes);
        let [x, y] = self.point();
        tick.path = PathKind::Line([[x, y], [x + dx, y + dy]]);
        if self.one_in(2) {
            tick.velocity_m_s = self.pick(&axes);
        }
        if self.one_in(2) {
            tick.force_n = self.pick(&axes);
        }
    }

    /// The arms all but stretched or folded.
    fn near_singular(&mut self, tick: &mut Tick) {
        let off_rad = self.magnitude(-7.3, -1.9);
        let [theta_a, theta_b] = &mut tick.base_rad;
        if self.one_in(2) {
            *theta_b = *theta_a - off_rad;
        } else {
            *theta_b = *theta_a - PI + off_rad;
        }
    }

    /// Gap and boundary exactly as far as the tip is from the path.
    fn at_reach(&mut self, tick: &mut Tick) {
        let Some(distance_m) = reference_distance_m(tick) else {
            return;
        };
        tick.boundary_m = distance_m.clamp(1.3e-7, 0.61);
        tick.law = match tick.law {
            Kind::Sdof { .. } => Kind::Sdof {
                gap_m: tick.boundary_m,
            },
            law => law,
        };
    }

    /// Pose, path and motion the same on the left and on the right, so that two brakes are as good.
    fn mirrored(&mut self, tick: &mut Tick) {
        tick.arms = arms(tick.layout);
        let [theta_a, theta_b] = &mut tick.base_rad;
        *theta_a = self.between(1.6, 3.05);
        *theta_b = PI - *theta_a;
        let (x, y) = (self.between(-0.2, 0.2), self.between(0.03, 0.67));
        tick.path = if self.one_in(2) {
            PathKind::Line([[0.0, 0.11], [0.0, 0.59]])
        } else {
            PathKind::Line([[x, y], [x + 0.31, y]])
        };
        let size = self.magnitude(-1.9, 0.3);
        tick.velocity_m_s = self.pick(&[[0.0, size], [size, 0.0], [0.0, -size]]);
        tick.force_n = self.pick(&[[0.0, 3.7], [3.7, 0.0], [-2.9, 0.0]]);
    }

    /// A number of either sign between −1 and 1.
    pub fn nudge(&mut self) -> f64 {
        self.between(-1.0, 1.0)
    }
}
