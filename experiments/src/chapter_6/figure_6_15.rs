//! Figure 6.15: the smoothness of simulated operators' runs by configuration and controller.

use rigproof_spec::layout::Layout;

use super::compared::{Compared, Metric, by_operators};
use super::trials::{AS_PRINTED, FIVE, LAYOUTS, Tried};
use crate::outline;
use crate::{Error, Experiment, Finding, Outcome};

/// DFT sum of acceleration.
pub const EXPERIMENT: Experiment = Experiment {
    id: "6.15",
    title: "DFT sum of acceleration by configuration and controller",
    what: "The runs of figure 6.13, by the DFT sum of the tip's acceleration; less is smoother. The unit of the tables is not said and is taken as SI.",
    run,
};

fn run() -> Result<Outcome, Error> {
    let metric = Metric {
        name: "DFT sum",
        unit: "m/s^3",
        logarithmic: true,
        of: |metrics| metrics.dft_sum_m_s3,
        printed: |cell| 1e5 * cell.dft_sum_e5,
    };
    let sum = Compared::new(metric)?;
    let [none, s, g, h, l] = FIVE;
    let mut findings = vec![
        smoother(&sum, "the gap increases smoothness", (g, s)),
        by_operators(smoother(
            &sum,
            "the low gain increases smoothness significantly",
            (l, h),
        )),
        smoother(
            &sum,
            "proportional control: smoother than SDOF, high gain against no gap",
            (h, s),
        ),
        by_operators(smoother(
            &sum,
            "proportional control: smoother than SDOF, low gain against the gap",
            (l, g),
        )),
        sum.no_gain(),
        as_printed(&sum, none),
    ];
    findings.extend(LAYOUTS.map(|layout| similar(&sum, layout)));
    findings.extend(LAYOUTS.map(|layout| sum.order(layout)));
    Ok(sum.outcome(EXPERIMENT.title, findings))
}

fn smoother(sum: &Compared, statement: &str, (one, other): (Tried, Tried)) -> Finding {
    sum.claim(
        (statement, "smoother"),
        |layout| {
            let (text, ratio) = sum.ratio(layout, one, other);
            (text, ratio < 1.0)
        },
        &format!("a smaller median; {}", sum.printed_ratios(one, other)),
    )
}

/// "The low gain proportional controller exhibited similar levels of … smoothness to the uncontrolled experiment."
fn similar(sum: &Compared, layout: Layout) -> Finding {
    let [none, .., low] = FIVE;
    let (text, ratio) = sum.ratio(layout, low, none);
    by_operators(Finding::claim(
        "§6.6",
        format!(
            "{}: the low gain is as smooth as no control",
            outline::name(layout)
        ),
        "similar",
        (text, ratio < 1.5),
        format!(
            "less than half as much again; {}. On three brakes at times no brake helps, and the locks of §6.3 catch a moving tip (decision 0048)",
            sum.printed_ratios(low, none)
        ),
    ))
}

fn as_printed(sum: &Compared, none: Tried) -> Finding {
    let [three, four] = LAYOUTS.map(|layout| sum.ratio(layout, AS_PRINTED, none));
    Finding {
        stated: "not stated".to_owned(),
        ..Finding::lost(
            "table 6.1",
            "the smoothness with the low gain as printed, 5 N·s/m",
            format!("3-brake {}; 4-brake {}", three.0, four.0),
            "no statement of the text is about this unit (erratum gain-unit)",
        )
    }
}
