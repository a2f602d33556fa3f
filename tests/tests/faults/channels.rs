//! This file spoils what a channel is: dead, turned, in another unit, another column; with an unknown inertia as with a known one.

use super::made::{self, Made};
use super::{assert_fault, diagnosed};
use rigproof_diagnose::report::Verdict;

fn unknown(made: Made) -> Made {
    made.described(
        "inertia = { value = 0.012, unit = \"kg·m^2/rad\", status = \"known\" }",
        "inertia = { value = 0.02, unit = \"kg·m^2/rad\", status = \"unknown\" }",
    )
}

/// Without what is stated of counts and noise, which would tell the unit by itself.
fn unstated(made: Made) -> Made {
    made.described(", quantum = 2e-5", "")
        .described(", noise = 1e-3", "")
}

#[test]
fn an_axis_with_an_unknown_inertia_as_such_is_consistent() {
    super::assert_consistent(&diagnosed(&unknown(made::axis())));
}

#[test]
fn a_command_that_is_dead_is_a_fault() {
    for level in [0.0, 0.7] {
        for made in [made::axis(), unknown(made::axis())] {
            assert_fault(
                &made.with("u", |x| x.fill(level)),
                "effort",
                None,
                "throughout",
            );
        }
    }
    assert_fault(
        &made::bench().with("torque", |x| x.fill(0.0)),
        "effort",
        None,
        "moves",
    );
}

#[test]
fn a_wrong_sign_is_a_fault() {
    let turned = |made: Made, name: &str| made.with(name, |x| x.iter_mut().for_each(|x| *x = -*x));
    assert_fault(&turned(made::axis(), "u"), "drive", None, "wrong sign");
    assert_fault(
        &turned(unknown(made::axis()), "u"),
        "inertia",
        None,
        "wrong sign",
    );
    assert_fault(
        &turned(made::bench(), "torque"),
        "effort",
        None,
        "wrong sign",
    );
}

#[test]
fn degrees_for_radians_are_a_fault_also_where_no_counts_are_stated() {
    let degrees =
        |made: Made| made.with("angle", |x| x.iter_mut().for_each(|x| *x = x.to_degrees()));
    assert_fault(&degrees(made::axis()), "position", None, "degrees");
    assert_fault(&degrees(made::bench()), "position", None, "degrees");
    assert_fault(&degrees(unstated(made::axis())), "drive", None, "degrees");
    assert_fault(
        &degrees(unstated(unknown(made::axis()))),
        "inertia",
        None,
        "degrees",
    );
}

#[test]
fn thousandths_of_a_unit_are_a_fault_also_where_no_noise_is_stated() {
    let more =
        |made: Made, name: &str| made.with(name, |x| x.iter_mut().for_each(|x| *x *= 1000.0));
    assert_fault(&more(made::axis(), "u"), "effort", None, "thousandths");
    assert_fault(
        &more(made::bench(), "torque"),
        "effort",
        None,
        "thousandths",
    );
    assert_fault(
        &more(unstated(made::axis()), "u"),
        "drive",
        None,
        "thousandths",
    );
    assert_fault(
        &more(unstated(unknown(made::axis())), "u"),
        "inertia",
        None,
        "thousandths",
    );
    let force = ["force_x", "force_y"]
        .into_iter()
        .fold(made::five_bar(), more);
    assert_fault(&force, "force_x", None, "mN");
}

#[test]
fn another_column_is_no_fit() {
    for made in [made::axis(), unknown(made::axis())] {
        let angle = made.samples("angle").to_vec();
        let speed: Vec<f64> = (0..angle.len())
            .map(|k| 500.0 * (angle[(k + 1).min(angle.len() - 1)] - angle[k.saturating_sub(1)]))
            .collect();
        // The position for the command.
        let report = diagnosed(&made.clone().with("u", |x| *x = angle.clone()));
        assert_eq!(report.verdict, Verdict::DataFault, "{}", report.summary);
        // The speed for the position is not seen to be one: laws over the position are named, and the verdict says that they are not all.
        let report = diagnosed(&made.clone().with("angle", |x| *x = speed.clone()));
        let fits = [Verdict::Consistent, Verdict::Explained, Verdict::Ambiguous];
        assert!(!fits.contains(&report.verdict), "{}", report.summary);
    }
}

#[test]
fn channels_of_a_five_bar_that_are_taken_for_each_other_are_a_fault() {
    for [one, other] in [["theta_a", "theta_b"], ["force_x", "force_y"]] {
        let made = made::five_bar();
        let (first, second) = (made.samples(one).to_vec(), made.samples(other).to_vec());
        let spoilt = made.with(one, |x| *x = second).with(other, |x| *x = first);
        let report = diagnosed(&spoilt);
        assert_eq!(
            report.verdict,
            Verdict::DataFault,
            "{one}: {}",
            report.summary
        );
    }
}
