//! This file holds every step with brakes and resistance laws, and what is seen of it, against the same scheme written with the reference's
//! functions: momentum, yields, memories, the moment at which a joint turns back.

mod checks;

use nalgebra::{SMatrix, Vector2};
use rigproof_impl::plant::brake::{Brake, Characteristic, Turn};
use rigproof_impl::plant::current::CurrentPath;
use rigproof_impl::plant::effect::{Asked, Law};
use rigproof_impl::plant::friction::Contact;
use rigproof_impl::plant::{Outcome, Parameters, Plant, Scheme};
use rigproof_model::effects::{Form, Instant, LIBRARY, entry, law};
use rigproof_model::linkage::{Pose, forward};
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use crate::impl_plant::rigs::{Draw, LAYOUTS, campaign};

type Rows = SMatrix<f64, 4, 2>;

/// Rounding of torques, N·m, and of rates, rad/s.
const CLOSE: f64 = 1e-9;

/// A resistance law on a joint, with its memory.
struct Resisting {
    joint: Joint,
    mechanism: Mechanism,
    parameters: Vec<f64>,
    memory: f64,
}

impl Resisting {
    /// Up to three of the library's.
    fn drawn(draw: &mut Draw) -> Vec<Resisting> {
        let mut effects = Vec::new();
        for _ in 0..3 {
            let entry = &LIBRARY[(draw.between(0.0, 0.999_9) * LIBRARY.len() as f64) as usize];
            let joint = Joint::ALL[draw.between(0.0, 3.999) as usize];
            let (Form::Resistance(_) | Form::ShareOfBrake(_)) = entry.form else {
                continue;
            };
            let names = entry.mechanism.parameters();
            let whole = draw.one_in(2);
            let needed = names.iter().filter(|name| !name.is_optional || whole);
            let mut parameters: Vec<f64> = needed.map(|_| draw.between(0.03, 0.31)).collect();
            match entry.mechanism {
                // So that rounding of a rate changes nothing.
                Mechanism::Stribeck => parameters[2] += 1.0,
                Mechanism::VelocityPower => parameters[1] += 1.0,
                Mechanism::DryOffset if draw.one_in(2) => parameters[0] *= -7.0,
                _ => {}
            }
            let reference = law(entry.mechanism, &parameters).unwrap();
            effects.push(Resisting {
                joint,
                mechanism: entry.mechanism,
                parameters,
                memory: reference.starts_with(),
            });
        }
        effects
    }
}

/// What the reference's functions need to know of a plant beside what is seen of it.
struct Followed {
    plant: Plant,
    parameters: Parameters,
    effects: Vec<Resisting>,
    paths: [CurrentPath; 4],
    /// The joints where forces were last looked at, rad, and how long before now, s.
    looked_rad: [f64; 4],
    since_look_s: f64,
    accelerations: Vector2<f64>,
    time_s: f64,
    seen: Seen,
}

/// How often what was met.
#[derive(Debug, Default)]
struct Seen {
    rest: u32,
    held: u32,
    slipping: u32,
    divided: u32,
    below: u32,
}

fn angles_rad(pose: &Pose) -> [f64; 4] {
    [
        pose.theta_a_rad,
        pose.theta_e_rad,
        pose.theta_b_rad,
        pose.theta_c_rad,
    ]
}

/// One step at the moment at which forces are looked at.
struct Looked {
    form: TwoCoordinate,
    /// Rows of the joints' rates at the start and at the end, foreseen from there.
    rows: [Rows; 2],
    /// Without the brakes, N·m.
    drive: Vector2<f64>,
    yields_nm: [f64; 4],
    /// What brake and other dry friction resist with together, N·m.
    bounds_nm: [f64; 4],
    /// A law asked for the sense of a joint whose rate is rounding.
    is_anyones: bool,
}

impl Followed {
    fn new(draw: &mut Draw, number: usize) -> Option<Followed> {
        let layout = LAYOUTS[number % 2];
        let scheme = [
            Scheme::Midpoint,
            Scheme::Midpoint,
            Scheme::SemiImplicitEuler,
        ][number % 3];
        let parameters = Parameters {
            scheme,
            inertia: draw.inertia(),
            ..Parameters::of(layout)
        };
        let theta = [draw.between(1.9, 2.5), draw.between(0.6, 1.2)];
        let v = if draw.one_in(3) {
            [0.0; 2]
        } else {
            [draw.between(-1.7, 1.7), draw.between(-1.7, 1.7)]
        };
        let effects = if draw.one_in(2) {
            Vec::new()
        } else {
            Resisting::drawn(draw)
        };
        let currents: &[_] = if draw.one_in(3) {
            &[
                (Joint::E, Mechanism::Lag, [draw.between(0.003, 0.03)]),
                (Joint::B, Mechanism::GainError, [draw.between(-0.3, 0.1)]),
            ]
        } else {
            &[]
        };
        let mut paths = [CurrentPath::default(); 4];
        for (joint, mechanism, parameters) in currents {
            let path = &mut paths[*joint as usize];
            *path = path.with(*mechanism, parameters).unwrap();
        }
        let resisting = effects
            .iter()
            .map(|of| (of.joint, of.mechanism, of.parameters.as_slice()));
        let of_currents = currents
            .iter()
            .map(|(joint, mechanism, parameters)| (*joint, *mechanism, parameters.as_slice()));
        let asked: Vec<Asked> = resisting
            .chain(of_currents)
            .map(|(joint, mechanism, parameters)| Asked {
                joint,
                mechanism,
                parameters,
            })
            .collect();
        let pose = forward::pose(&parameters.arms, theta[0], theta[1]).ok()?;
        Some(Followed {
            plant: Plant::new(&parameters, theta, v, &asked)?,
            parameters,
            effects,
            paths,
            looked_rad: angles_rad(&pose),
            since_look_s: 0.0,
            accelerations: Vector2::zeros(),
            time_s: 0.0,
            seen: Seen::default(),
        })
    }

    fn form_at(&self, theta: Vector2<f64>, rates: Vector2<f64>) -> (Pose, TwoCoordinate) {
        let pose = forward::pose(&self.parameters.arms, theta.x, theta.y).unwrap();
        let form = two_coordinate(
            &self.parameters.arms,
            &self.parameters.inertia,
            &pose,
            rates.into(),
        );
        (pose, form)
    }

    /// The forces of a step; memories, brakes and currents move on.
    fn look(
        &mut self,
        before: &Plant,
        brakes: &mut [Brake; 4],
        force_n: [f64; 2],
        currents_a: [f64; 4],
        step_s: f64,
    ) -> Looked {
        let lead_s = if self.parameters.scheme == Scheme::Midpoint {
            0.5 * step_s
        } else {
            0.0
        };
        let (theta, v) = (
            Vector2::from(before.base_angles_rad()),
            Vector2::from(before.base_rates_rad_s()),
        );
        let (middle, u) = (theta + v * lead_s, v + self.accelerations * lead_s);
        let (pose, form) = self.form_at(middle, u);
        // How the rows change along the rates, by a difference.
        let short_s = 1e-5;
        let [after, before] =
            [short_s, -short_s].map(|time_s| self.form_at(middle + u * time_s, u).1.joints);
        let by_s = (after - before) / (2.0 * short_s);
        let rows = [-lead_s, lead_s].map(|time_s| form.joints + by_s * time_s);
        let speeds = form.joint_rates_rad_s(u.into());
        let mut yields_nm = [0.0; 4];
        for i in 0..4 {
            let current_a = self.paths[i].step(currents_a[i], step_s);
            let Some(table) = &self.parameters.brakes[i] else {
                continue;
            };
            let turn = Turn {
                way_rad: [self.looked_rad[i], angles_rad(&pose)[i]],
                around_s: [self.since_look_s, lead_s],
                speed_rad_s: speeds[i],
                step_s,
            };
            yields_nm[i] = brakes[i].step(&Characteristic::new(table), current_a, &turn);
        }
        self.looked_rad = angles_rad(&pose);
        self.since_look_s = step_s - lead_s;
        let mut looked = Looked {
            drive: form.drive(force_n),
            form,
            rows,
            yields_nm,
            bounds_nm: [0.0; 4],
            is_anyones: false,
        };
        self.resist(&mut looked, speeds, lead_s, step_s);
        looked
    }

    /// What the resistance laws add to a step.
    fn resist(&mut self, looked: &mut Looked, speeds: [f64; 4], lead_s: f64, step_s: f64) {
        for effect in &self.effects {
            let i = effect.joint as usize;
            let speed = speeds[i];
            let reference = law(effect.mechanism, &effect.parameters).unwrap();
            let now = Instant {
                time_s: self.time_s + lead_s,
                position: self.looked_rad[i],
                speed,
                sense: if speed < 0.0 { -1.0 } else { 1.0 },
            };
            let other = Instant {
                sense: -now.sense,
                ..now
            };
            let yield_nm = looked.yields_nm[i];
            let parts = |at, memory| match entry(effect.mechanism).map(|entry| entry.form) {
                Some(Form::ShareOfBrake(_)) => {
                    let (smooth, dry) = reference.parts(at, memory);
                    [yield_nm * smooth, yield_nm * dry]
                }
                _ => [reference.smooth(at, memory), reference.dry(at)],
            };
            let own = Law::new(effect.mechanism, &effect.parameters).unwrap();
            let [_, halfway] = own.remember(effect.memory, speed, step_s);
            let is_still = speed.abs() < 1e-9;
            // A memory at the edge of a gap is left by a rate that is rounding.
            let asks = |memory| parts(&now, memory)[0] != parts(&other, memory)[0];
            looked.is_anyones |= is_still && (asks(effect.memory) || asks(halfway));
            let [smooth, dry] = parts(&now, halfway);
            looked.drive -= looked.form.joints.row(i).transpose() * smooth;
            looked.bounds_nm[i] += dry;
        }
        for (bound_nm, yield_nm) in looked.bounds_nm.iter_mut().zip(looked.yields_nm) {
            self.seen.below += u32::from(*bound_nm < -yield_nm);
            *bound_nm = f64::max(*bound_nm + yield_nm, 0.0);
        }
    }

    /// One step, and whether it was the scheme's; false where the linkage cannot go there or is near a singularity.
    fn step(&mut self, force_n: [f64; 2], currents_a: [f64; 4], step_s: f64) -> bool {
        let before = self.plant;
        let [a, b] = before.base_angles_rad();
        let Ok(pose) = forward::pose(&self.parameters.arms, a, b) else {
            return false;
        };
        let inner = [pose.theta_e_rad, pose.theta_c_rad, pose.theta_d_rad];
        if inner.into_iter().any(|angle| libm::sin(angle).abs() < 0.17) {
            return false;
        }
        let mut brakes = *before.brakes();
        if self.plant.step(force_n, currents_a, step_s) != Outcome::Moved {
            return false;
        }
        let looked = self.look(&before, &mut brakes, force_n, currents_a, step_s);
        let (theta, v) = (
            Vector2::from(before.base_angles_rad()),
            Vector2::from(before.base_rates_rad_s()),
        );
        let after = Vector2::from(self.plant.base_rates_rad_s());
        let lead_s = step_s - self.since_look_s;
        let end = theta + v * lead_s + after * (step_s - lead_s);
        assert!((Vector2::from(self.plant.base_angles_rad()) - end).norm() < 1e-14);
        for (i, brake) in brakes
            .iter()
            .enumerate()
            .filter(|(i, _)| self.parameters.brakes[*i].is_some())
        {
            assert!((brake.yield_nm() - self.plant.brakes()[i].yield_nm()).abs() < CLOSE);
            assert_eq!(
                self.plant.yield_torques_nm()[i],
                self.plant.brakes()[i].yield_nm()
            );
        }
        if !looked.is_anyones {
            self.check_momentum(&before, &looked, after - v, step_s);
        }
        self.time_s += step_s;
        self.accelerations = (after - v) / step_s;
        if self.plant.contact() == Contact::Rest {
            self.accelerations = Vector2::zeros();
            assert_eq!(after, Vector2::zeros());
        }
        for effect in &mut self.effects {
            let own = Law::new(effect.mechanism, &effect.parameters).unwrap();
            let mean =
                looked.form.joint_rates_rad_s((0.5 * (v + after)).into())[effect.joint as usize];
            [effect.memory, _] = own.remember(effect.memory, mean, step_s);
        }
        self.check_seen(&looked);
        true
    }
}

#[test]
fn every_step_with_brakes_is_the_scheme_worked_with_the_references_functions() {
    let mut draw = Draw::new(7_411);
    let mut all = Seen::default();
    for number in 0..campaign(600) {
        let Some(mut followed) = Followed::new(&mut draw, number) else {
            continue;
        };
        let layout = if followed.parameters.brakes[3].is_some() {
            Layout::FourBrake
        } else {
            Layout::ThreeBrake
        };
        let (mut force_n, mut currents_a) = ([0.0; 2], [0.0; 4]);
        for k in 0..80 {
            if k % 9 == 0 {
                let size = draw.between(1.0, 23.0);
                force_n = [draw.between(-size, size), draw.between(-size, size)];
            }
            if k % 13 == 0 {
                currents_a = [0; 4].map(|_| libm::pow(draw.between(0.0, 1.0), 2.0));
                if layout == Layout::ThreeBrake {
                    currents_a[3] = 0.0;
                }
            }
            let step_s = draw.between(2e-4, 2.1e-3);
            if !followed.step(force_n, currents_a, step_s) {
                break;
            }
        }
        let Seen {
            rest,
            held,
            slipping,
            divided,
            below,
        } = followed.seen;
        all.rest += rest;
        all.held += held;
        all.slipping += slipping;
        all.divided += divided;
        all.below += below;
    }
    println!("{all:?}");
    let often = [all.rest, all.held, all.slipping, all.divided];
    let is_varied = often.iter().all(|&count| count > 600) && all.below > 100;
    assert!(is_varied || campaign(600) < 600, "{all:?}");
}
