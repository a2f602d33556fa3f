//! Figure 6.14: the average tip force of simulated operators by configuration and controller.

use super::compared::{Compared, Metric, by_operators};
use super::trials::{AS_PRINTED, FIVE, LAYOUTS, Tried};
use crate::{Error, Experiment, Finding, Outcome};

/// Tip force.
pub const EXPERIMENT: Experiment = Experiment {
    id: "6.14",
    title: "Average tip force by configuration and controller",
    what: "The runs of figure 6.13, by the force of the operator on the tip.",
    run,
};

fn run() -> Result<Outcome, Error> {
    let metric = Metric {
        name: "tip force",
        unit: "N",
        logarithmic: false,
        of: |metrics| metrics.tip_force_n,
        printed: |cell| cell.tip_force_n,
    };
    let force = Compared::new(metric)?;
    let [none, s, g, h, l] = FIVE;
    let mut findings = vec![
        lighter(&force, "the gap decreases workload", (g, s), 1.0),
        lighter(
            &force,
            "the low gain reduces workload significantly",
            (l, h),
            0.75,
        ),
        by_operators(lighter(
            &force,
            "proportional control: lower workload than SDOF, high gain against no gap",
            (h, s),
            1.0,
        )),
        by_operators(lighter(
            &force,
            "proportional control: lower workload than SDOF, low gain against the gap",
            (l, g),
            1.0,
        )),
        similar(&force),
        force.no_gain(),
        as_printed(&force, none),
    ];
    findings.extend(LAYOUTS.map(|layout| force.order(layout)));
    Ok(force.outcome(EXPERIMENT.title, findings))
}

fn lighter(force: &Compared, statement: &str, (one, other): (Tried, Tried), most: f64) -> Finding {
    force.claim(
        (statement, "less"),
        |layout| {
            let (text, ratio) = force.ratio(layout, one, other);
            (text, ratio < most)
        },
        &format!(
            "medians, less than {most} of the other; {}",
            force.printed_ratios(one, other)
        ),
    )
}

fn similar(force: &Compared) -> Finding {
    let [none, .., low] = FIVE;
    let finding = force.claim(
        (
            "the low gain: a workload similar to that of no control",
            "similar",
        ),
        |layout| {
            let (text, ratio) = force.ratio(layout, low, none);
            (text, (1.0 / 1.4..=1.4).contains(&ratio))
        },
        &format!(
            "within a factor of 1.4, that of the people's means (erratum low-gain-workload); {}",
            force.printed_ratios(low, none)
        ),
    );
    match finding.is_unaccounted() {
        true => finding.accounted("low-gain-workload"),
        false => finding,
    }
}

fn as_printed(force: &Compared, none: Tried) -> Finding {
    let [three, four] = LAYOUTS.map(|layout| force.ratio(layout, AS_PRINTED, none));
    Finding {
        stated: "not stated".to_owned(),
        ..Finding::lost(
            "table 6.1",
            "the workload with the low gain as printed, 5 N·s/m",
            format!("3-brake {}; 4-brake {}", three.0, four.0),
            "no statement of the text is about this unit (erratum gain-unit)",
        )
    }
}
