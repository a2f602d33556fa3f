//! This file holds the single ticks of the campaigns that were once decided otherwise and traced: optimal control where two forces cost the same
//! to rounding (decision 0117).

use nalgebra::Vector2;
use rigproof_certify::built_in::Kind;
use rigproof_certify::differential::both::{View, reference_command, rig_law, situation};
use rigproof_certify::differential::level::cost_the_same;
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::permitted::{Permitted, permitted};
use rigproof_certify::differential::tick::{PathKind, Tick};
use rigproof_certify::differential::tie::Tie;
use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use crate::impl_laws::sample::Sampler;

fn rig<R: Real>(tick: &Tick) -> Command {
    let mut law = rig_law::<R>(tick).expect("plain settings");
    law.command(&situation(tick)).into()
}

#[test]
fn on_folded_arms_two_brakes_cost_the_same_to_the_last_digit_of_the_energies() {
    let mut sampler = Sampler::new(93_004_430);
    let tick = (0..862).map(|_| sampler.adverse()).last().unwrap();
    let speed_m_s = Vector2::from(tick.velocity_m_s).norm();
    assert!(speed_m_s > 1011.0, "{tick:?}");
    let mut nudger = Nudger::new(53);
    let [a, e, b] =
        [Joint::A, Joint::E, Joint::B].map(|joint| Command::none(Reason::Chosen(joint)));
    let reference = reference_command(&tick, View::EXACT).unwrap();
    // Computed with sixty digits, A costs 1.960514e-12 less than the push alone and B 1.879201e-12: the reference is right.
    assert_eq!((reference, rig::<f64>(&tick)), (a, b));
    let verdict = permitted(&tick, Some(reference), b, &mut nudger);
    assert_eq!(verdict, Ok(Permitted::Tie(Tie::Level)));
    // Neither what E would cost nor the push alone is as near, nor is a brake with current, nor the same under another law.
    let mut strong = b;
    strong.currents_a[2] = 0.031;
    for wrong in [e, Command::none(Reason::NoneHelps), strong] {
        let verdict = permitted(&tick, Some(reference), wrong, &mut nudger);
        assert!(verdict.is_err(), "{wrong:?} passes as {verdict:?}");
    }
    let mut other = tick.clone();
    other.law = Kind::Proportional {
        gain_n_s_per_m: 570.3,
    };
    assert!(!cost_the_same(&other, &a, b, 1.0));
}

#[test]
fn in_single_precision_a_brake_that_stops_its_joint_at_once_costs_as_much_as_none() {
    let corners_m = vec![
        [0.3752391637761797, 0.3731621848426082],
        [-0.08129067295998471, 0.17448586438228234],
        [-0.3748102148986231, 0.5382961880505872],
        [-0.4265366623415562, 0.20201804711263754],
        [-0.21701026097112264, 0.44259409311031583],
    ];
    // From seeds 2 003 000 on, with the arms 5.3° from a line.
    let tick = Tick {
        layout: Layout::ThreeBrake,
        arms: Arms {
            l_ae_m: 0.3768520178820266,
            l_ed_m: 0.3264712880939654,
            l_bc_m: 0.6656566052868658,
            l_cd_m: 0.40183308722541167,
            l_ab_m: 0.3614886163271557,
        },
        limit_n: 69.17328681550994,
        base_rad: [2.5183454258719324, 2.4250728182625103],
        velocity_m_s: [-0.0002184252258249834, -0.00018486909443210764],
        force_n: [41.807731250805055, 31.543322655578365],
        path: PathKind::Polyline(corners_m, true),
        boundary_m: 0.2357499095470055,
        law: Kind::Optimal {
            weight_angle: 6.512215268816821,
            weight_energy: 0.7045518037578258,
            horizon_s: 0.0005166695389253538,
        },
        obstacle: None,
    };
    let (a, none) = (
        Command::none(Reason::Chosen(Joint::A)),
        Command::none(Reason::NoneHelps),
    );
    assert_eq!((rig::<f64>(&tick), rig::<f32>(&tick)), (a, none));
    let single = f64::from(f32::EPSILON);
    assert!(cost_the_same(&tick, &a, none, single));
    // Double precision can tell; and the push stops the joints of the others, so that they are not tried.
    assert!(!cost_the_same(&tick, &a, none, f64::EPSILON));
    for joint in [Joint::E, Joint::B] {
        let other = Command::none(Reason::Chosen(joint));
        assert!(!cost_the_same(&tick, &a, other, single), "{joint:?}");
    }
}
