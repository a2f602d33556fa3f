//! Figure 6.13: the average path error of simulated operators by configuration and controller.

use rigproof_spec::trials::{LINES, OPERATORS, averages};

use super::compared::{Compared, Metric, by_operators};
use super::trials::{AS_PRINTED, FIVE, LAYOUTS};
use crate::outline::cm;
use crate::{Error, Experiment, Finding, Outcome};

/// Path error.
pub const EXPERIMENT: Experiment = Experiment {
    id: "6.13",
    title: "Average path error by configuration and controller",
    what: "The experiment of §6.5 with three simulated operators, nine runs each on two lines, both configurations and the five controllers (gains in N·s/cm), and the low gain as printed; people and lines are lost.",
    run,
};

fn run() -> Result<Outcome, Error> {
    let metric = Metric {
        name: "path error",
        unit: "cm",
        logarithmic: false,
        of: |metrics| cm(metrics.path_error_m),
        printed: |cell| cell.path_error_cm,
    };
    let error = Compared::new(metric)?;
    let mut findings = vec![
        reduced(&error),
        similar(&error),
        consistent(&error),
        gap_costs(&error),
        gain_costs(&error),
        wider(&error),
        error.no_gain(),
        second_line(&error),
        as_printed(&error),
    ];
    findings.extend(LAYOUTS.map(|layout| error.order(layout)));
    Ok(error.outcome(EXPERIMENT.title, findings))
}

fn reduced(error: &Compared) -> Finding {
    let [none, controlled @ ..] = FIVE;
    error.claim(
        (
            "both controllers reduce path error, whatever the gain",
            "significantly",
        ),
        |layout| {
            let without = error.five(layout, none);
            let each = controlled.map(|tried| (tried.letter, error.five(layout, tried)));
            let apart = |(_, five): &(&str, _)| upper(five) < without.quartiles[0];
            let text = each
                .iter()
                .map(|(letter, five)| format!("{letter} {:.3}", five.median));
            let text: Vec<String> = text.collect();
            (
                format!("N {:.3}, {} cm", without.median, text.join(", ")),
                each.iter().all(apart),
            )
        },
        "every box lies below that of no control",
    )
}

fn upper(five: &super::boxes::Five) -> f64 {
    five.quartiles[1]
}

fn similar(error: &Compared) -> Finding {
    let [_, s, _, h, _] = FIVE;
    let finding = error.claim(
        (
            "both controllers offer a similar improvement in accuracy (§7.1)",
            "similar",
        ),
        |layout| {
            let (text, ratio) = error.ratio(layout, h, s);
            (text, (0.5..=2.0).contains(&ratio))
        },
        &format!("within a factor of two; {}", error.printed_ratios(h, s)),
    );
    by_operators(finding)
}

fn consistent(error: &Compared) -> Finding {
    let [n, s, g, h, l] = FIVE;
    let finding = error.claim(
        (
            "SDOF with a gap is far more consistent in accuracy than the others",
            "far greater consistency",
        ),
        |layout| {
            let span = |tried| error.five(layout, tried).span();
            let others = [n, s, h, l].map(|tried| format!("{} {:.3}", tried.letter, span(tried)));
            let least = [n, s, h, l]
                .map(span)
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            (
                format!("span of the box G {:.3}, {} cm", span(g), others.join(", ")),
                span(g) < 0.5 * least,
            )
        },
        "the box of G spans less than half of any other",
    );
    by_operators(finding)
}

fn gap_costs(error: &Compared) -> Finding {
    let [_, s, g, ..] = FIVE;
    let finding = error.claim(
        ("the gap sacrifices a negligible amount of accuracy", "negligible"),
        |layout| {
            let (text, ratio) = error.ratio(layout, g, s);
            (text, ratio < 1.5)
        },
        &format!(
            "less than half as much again; {}. The gap of 0.5 cm fills with the aim's error, which the simulated operator does not correct inside it (decision 0048)",
            error.printed_ratios(g, s)
        ),
    );
    by_operators(finding)
}

fn gain_costs(error: &Compared) -> Finding {
    let [.., h, l] = FIVE;
    let finding = error.claim(
        ("the low gain changes accuracy little", "little change"),
        |layout| {
            let (text, ratio) = error.ratio(layout, l, h);
            let change_cm = (error.median(layout, l) - error.median(layout, h)).abs();
            (text, (0.5..=2.0).contains(&ratio) || change_cm < 0.1)
        },
        &format!(
            "within a factor of two, or a millimetre; {}",
            error.printed_ratios(l, h)
        ),
    );
    by_operators(finding)
}

fn wider(error: &Compared) -> Finding {
    let [none, ..] = FIVE;
    let [three, four] = LAYOUTS.map(|layout| error.five(layout, none));
    let range = |five: &super::boxes::Five| five.whiskers[1] - five.whiskers[0];
    let [people_three, people_four] = LAYOUTS.map(|layout| {
        let cells = error.printed(layout, none);
        let most = cells.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - cells.iter().copied().fold(f64::INFINITY, f64::min)
    });
    by_operators(Finding::claim(
        "§6.6",
        "without control the path error varies over a much wider range on four brakes",
        "much wider",
        (
            format!(
                "whiskers {:.3} cm apart against {:.3} cm",
                range(&four),
                range(&three)
            ),
            range(&four) > 1.5 * range(&three),
        ),
        format!(
            "more than half as wide again; the cells of tables C, means of three, lie {people_four:.2} cm apart against {people_three:.2} cm"
        ),
    ))
}

/// "In general, the average path error is greater for line 2 than for line 1."
fn second_line(error: &Compared) -> Finding {
    let mut counts = [(0, 0); 2];
    let [ours, people] = &mut counts;
    for layout in LAYOUTS {
        for (tried, operator) in FIVE.into_iter().flat_map(|t| OPERATORS.map(|o| (t, o))) {
            let [first, second] = LINES.map(|line| error.cell(layout, tried, operator, line));
            ours.0 += u32::from(second > first);
            ours.1 += 1;
            let cells = LINES.map(|line| averages(operator, layout, tried.method, line));
            if let [Some(first), Some(second)] = cells {
                people.0 += u32::from(second.path_error_cm > first.path_error_cm);
                people.1 += 1;
            }
        }
    }
    let finding = Finding::claim(
        "§6.6",
        "the path error is greater on line 2 than on line 1",
        "in general",
        (
            format!("in {} of {} cells", ours.0, ours.1),
            3 * ours.0 >= 2 * ours.1,
        ),
        format!(
            "in two cells of three; in tables C in {} of {}, and the lines themselves are lost",
            people.0, people.1
        ),
    );
    match finding.is_unaccounted() {
        true => finding.accounted("line-2-error"),
        false => finding,
    }
}

fn as_printed(error: &Compared) -> Finding {
    let [none, ..] = FIVE;
    let finding = error.claim(
        (
            "the low gain as printed, 5 N·s/m, reduces path error",
            "significantly",
        ),
        |layout| {
            let (text, ratio) = error.ratio(layout, AS_PRINTED, none);
            (text, ratio < 0.65)
        },
        "by a third at least",
    );
    match finding.is_unaccounted() {
        true => finding.accounted("gain-unit"),
        false => finding,
    }
}
