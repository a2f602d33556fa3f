//! This file says what must hold of a step that was taken: momentum, the moment of a turn, and what is seen.

use nalgebra::{SMatrix, Vector2};
use rigproof_impl::plant::Plant;
use rigproof_impl::plant::friction::Contact;

use super::{CLOSE, Followed, Looked, angles_rad};

fn column(of: [f64; 4]) -> SMatrix<f64, 4, 1> {
    SMatrix::<f64, 4, 1>::from(of)
}

impl Followed {
    /// What the brakes exerted in the end of the step, N·m, by what they are said to have done; none where it cannot be told from the share of a
    /// joint's other friction.
    fn torques_nm(&self, looked: &Looked) -> Option<[f64; 4]> {
        let signs = match self.plant.contact() {
            Contact::Rest => [0.0; 4],
            Contact::Along { signs, .. } | Contact::Slipping(signs) => signs,
        };
        let mut torques_nm = [0.0; 4];
        for i in 0..4 {
            let (bound_nm, own_nm) = (looked.bounds_nm[i], self.plant.brake_torques_nm()[i]);
            let share = if bound_nm > 0.0 {
                f64::min(looked.yields_nm[i] / bound_nm, f64::INFINITY)
            } else {
                1.0
            };
            assert_eq!(self.plant.stuck()[i], bound_nm > 0.0 && signs[i] == 0.0);
            if self.plant.stuck()[i] {
                if share == 0.0 {
                    assert_eq!(own_nm, 0.0);
                    return None;
                }
                torques_nm[i] = own_nm / share;
                assert!(torques_nm[i].abs() <= bound_nm * (1.0 + CLOSE));
            } else {
                torques_nm[i] = -signs[i] * bound_nm;
                assert!(
                    (own_nm - torques_nm[i] * share).abs() < CLOSE,
                    "{own_nm} {torques_nm:?} {share}"
                );
            }
        }
        Some(torques_nm)
    }

    /// M·(v⁺ − v) is the impulse of forces and brakes, before and after a joint turned back.
    pub(super) fn check_momentum(
        &mut self,
        before: &Plant,
        looked: &Looked,
        change: Vector2<f64>,
        step_s: f64,
    ) {
        let Some(torques_nm) = self.torques_nm(looked) else {
            return;
        };
        let (mass, drive) = (looked.form.mass, looked.drive * step_s);
        let impulse =
            |torques_nm: [f64; 4]| looked.form.joints.transpose() * column(torques_nm) * step_s;
        let left = mass * change - drive - impulse(torques_nm);
        let close = CLOSE * (drive.norm() + impulse(looked.bounds_nm).norm() + step_s);
        match (before.contact(), self.plant.contact()) {
            (Contact::Slipping(signs), now) => {
                let known = (0..4).all(|i| signs[i] != 0.0 || looked.bounds_nm[i] == 0.0);
                let (mut first, mut on) = (1.0, [0.0; 4]);
                if known {
                    for i in 0..4 {
                        on[i] = -signs[i] * looked.bounds_nm[i];
                    }
                    let v = Vector2::from(before.base_rates_rad_s());
                    let going_on = v + mass.try_inverse().unwrap() * (drive + impulse(on));
                    for i in (0..4).filter(|&i| looked.bounds_nm[i] > 0.0) {
                        let start = signs[i] * (looked.rows[0].row(i) * v).x;
                        let at_end = signs[i] * (looked.rows[1].row(i) * going_on).x;
                        if at_end <= 0.0 {
                            first = f64::min(
                                first,
                                f64::max(start, 0.0) / (f64::max(start, 0.0) - at_end),
                            );
                        }
                    }
                    if first == 1.0 {
                        assert_eq!(now, before.contact());
                    }
                }
                // The torques that are seen are those after the turn.
                let first = if first < 1.0 { first } else { 0.0 };
                let off = left - (impulse(on) - impulse(torques_nm)) * first;
                let close = close + 1e-6 * first * (1.0 - first) * impulse(looked.bounds_nm).norm();
                assert!(
                    off.norm() < close,
                    "{off:?} of {left:?}, {first}, {torques_nm:?} after {on:?}"
                );
                self.seen.divided += u32::from(first > 0.0);
            }
            (last, now) if last == Contact::Rest || last == now => {
                assert!(
                    left.norm() < close,
                    "{left:?} by {torques_nm:?}, {last:?} {now:?}"
                );
            }
            _ => {}
        }
    }

    /// What is seen of the plant is so.
    pub(super) fn check_seen(&mut self, looked: &Looked) {
        let plant = &self.plant;
        let (theta, v) = (
            Vector2::from(plant.base_angles_rad()),
            Vector2::from(plant.base_rates_rad_s()),
        );
        let (pose, form) = self.form_at(theta, v);
        let rates = form.joint_rates_rad_s(v.into());
        let foreseen = looked.rows[1] * v;
        let signs = match plant.contact() {
            Contact::Rest => [0.0; 4],
            Contact::Along { signs, .. } | Contact::Slipping(signs) => signs,
        };
        for i in 0..4 {
            assert!((plant.joint_angles_rad()[i] - angles_rad(&pose)[i]).abs() < 1e-11);
            let seen = plant.joint_rates_rad_s()[i];
            let torque_nm = plant.brake_torques_nm()[i];
            if plant.stuck()[i] {
                assert_eq!(seen, 0.0);
                assert!(
                    foreseen[i].abs() <= 1e-7 * v.norm(),
                    "{} {v:?}",
                    foreseen[i]
                );
            } else {
                let driven = torque_nm * rates[i] > 0.0;
                assert!(
                    (seen - rates[i]).abs() < CLOSE || driven && seen == 0.0,
                    "{seen} {rates:?}"
                );
                assert!(!driven || seen == 0.0 || rates[i].abs() < 1e-13);
                let told = looked.bounds_nm[i] == 0.0 || signs[i] * foreseen[i] >= -1e-7 * v.norm();
                assert!(told, "{signs:?} {foreseen:?}");
            }
        }
        let [x, y] = form.tip_velocity_m_s(v.into());
        let tip = plant.tip_velocity_m_s();
        assert!((tip.x - x).abs() < CLOSE && (tip.y - y).abs() < CLOSE);
        let [x, y] = pose.tip_m;
        assert!((plant.tip_m().x - x).abs() < 1e-12 && (plant.tip_m().y - y).abs() < 1e-12);
        let energy_j = 0.5 * v.dot(&(form.mass * v));
        assert!((plant.kinetic_energy_j() - energy_j).abs() <= CLOSE * energy_j);
        assert!((plant.time_s() - self.time_s).abs() < 1e-12);
        match plant.contact() {
            Contact::Rest => self.seen.rest += 1,
            Contact::Along { .. } => self.seen.held += 1,
            Contact::Slipping(_) => self.seen.slipping += 1,
        }
    }
}
