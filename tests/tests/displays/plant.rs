//! This file says that a display moves as the rig does where its rows are the rig's, and that two limited rates are solved exactly.

use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;
use rigproof_model::displays::{Aim, Body, Device, Display, Now, Place, Plant, Rows};
use rigproof_model::motion::friction::DryBrakes;
use rigproof_model::motion::limited::{LimitedRates, limited_motion};
use rigproof_model::rig::Rig;
use rigproof_spec::laws::velocity_limits;
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

/// Brakes on the rig's own joints with constant bounds.
#[derive(Debug)]
struct OnJoints([f64; 4]);

impl Device for OnJoints {
    fn decide(&mut self, _: &Aim<'_>, _: &Now<'_>) {}

    fn rows(&mut self, place: &Place, _: [f64; 2], _: f64) -> Rows {
        Rows::Dry(DryBrakes {
            rows: place.joints,
            bounds_nm: self.0,
        })
    }
}

/// How far a display whose rows are those of a layout is from the rig, m, after a push to and fro.
fn apart_m(layout: Layout, step_s: f64) -> f64 {
    let tip_m = [0.031, 0.347];
    let mut rig = Rig::new(layout, tip_m).unwrap();
    let body = Plant::new(Body::layout(layout), tip_m, [0.0; 2]).unwrap();
    let mut display = Display::new(body, OnJoints(rig.yield_torques_nm())).with_step_s(step_s);
    for k in 0..400_u32 {
        let sign = if k < 230 { 1.0 } else { -1.0 };
        let push = [4.7 * sign, -3.1 * sign];
        rig.step(push, [0.0; 4], 1e-3).unwrap();
        display.tick(&Aim::Free, push, 1e-3, |_| {}).unwrap();
    }
    let (one, other) = (rig.tip_m(), display.plant().place().tip_m);
    libm::hypot(one[0] - other[0], one[1] - other[1])
}

#[test]
fn a_display_with_the_rigs_rows_moves_as_the_rig() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let [coarse_m, fine_m] = [1e-4, 1e-5].map(|step_s| apart_m(layout, step_s));
        println!("{layout:?}: {coarse_m:e} m at 0.1 ms, {fine_m:e} m at 0.01 ms");
        assert!(coarse_m < 1e-4, "{layout:?}: {coarse_m} m");
        assert!(
            fine_m < coarse_m / 7.0,
            "{layout:?}: {fine_m} of {coarse_m} m"
        );
    }
}

#[derive(Clone, Copy, Debug)]
struct Problem {
    mass: Matrix2<f64>,
    drive: Vector2<f64>,
    clutches: LimitedRates,
}

/// Any two coordinates with two limited rates; every fifth problem stops one of them.
fn problem() -> impl Strategy<Value = Problem> {
    let mass = (0.07..2.3_f64, 0.07..2.3_f64, -0.97..0.97_f64);
    let rows = prop::array::uniform4(-1.9..1.9_f64);
    let limits = prop::array::uniform4(0.003..1.7_f64);
    let drive = (-3.0..3.0_f64, -3.0..3.0_f64);
    (mass, rows, limits, drive, 0_u8..5).prop_filter_map(
        "rows that are not parallel",
        |((m_1, m_2, part), rows, [a, b, c, d], drive, kind)| {
            let across = part * (m_1 * m_2).sqrt();
            let rows = Matrix2::from_row_slice(&rows);
            if rows.determinant().abs() < 0.03 {
                return None;
            }
            let second = if kind == 0 { [0.0, 0.0] } else { [-c, d] };
            Some(Problem {
                mass: Matrix2::new(m_1, across, across, m_2),
                drive: Vector2::new(drive.0, drive.1),
                clutches: LimitedRates {
                    rows,
                    limits_rad_s: [[-a, b], second],
                },
            })
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(20_000), ..ProptestConfig::default() })]

    #[test]
    fn limited_rates_are_solved_exactly(problem in problem(), aside in prop::array::uniform16(0.0..1.0_f64)) {
        let Problem { mass, drive, clutches } = problem;
        let done = limited_motion(&mass, &drive, &clutches);
        let motion = Vector2::from(done.motion);
        let loads = Vector2::from(done.loads);
        // Balance, and each load on its side only.
        let left = mass * motion - drive - clutches.rows.transpose() * loads;
        prop_assert!(left.norm() < 1e-9 * (1.0 + drive.norm()), "{left} is left");
        for i in 0..2 {
            let [least, greatest] = clutches.limits_rad_s[i];
            prop_assert!(velocity_limits(done.rates[i], [least, greatest]).holds());
            if done.rates[i] < greatest {
                prop_assert!(done.loads[i] >= 0.0);
            }
            if done.rates[i] > least {
                prop_assert!(done.loads[i] <= 0.0);
            }
            // Limits around rest: a clutch takes power or none.
            prop_assert!(done.loads[i] * done.rates[i] <= 0.0);
        }
        // No motion inside the limits has less energy: the motion is the least of a convex function.
        let energy = |v: Vector2<f64>| 0.5 * v.dot(&(mass * v)) - drive.dot(&v);
        let inverse = clutches.rows.try_inverse().unwrap();
        for pair in aside.chunks(2) {
            let rates = [0, 1].map(|i| {
                let [least, greatest] = clutches.limits_rad_s[i];
                least + (greatest - least) * pair[i]
            });
            let other = inverse * Vector2::from(rates);
            prop_assert!(energy(other) >= energy(motion) - 1e-9 * (1.0 + energy(motion).abs()));
        }
    }
}
