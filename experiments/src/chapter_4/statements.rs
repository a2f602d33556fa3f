//! This file sets the statements of chapter 4 beside a workspace, whoever traversed it.

use rigproof_model::linkage::sweep::Candidate;
use rigproof_model::linkage::workspace::Figures;
use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, angle_ranges};
use rigproof_spec::layout::Layout;

use super::layouts::{deg, name, well_spaced_percent};
use crate::{Finding, Verdict};

/// Between which angles the greatest angle of a 4-brake linkage varies (§4.3).
pub fn in_limits(of: &str, figures: &Figures) -> Finding {
    let (least, greatest) = (deg(figures.least_rad), deg(figures.greatest_rad));
    Finding::claim(
        "§4.3",
        "with four brakes the greatest angle between adjacent paths can vary",
        "between 45 and 180°",
        (
            format!("{least:.1} to {greatest:.1}° over the workspace of {of}"),
            least >= 45.0 && greatest <= 180.0,
        ),
        "both ends are bounds: 45° are four paths spread evenly, 180° would be four parallel ones",
    )
}

/// The ranges of a layout's angles, derived from the stops, beside table 4.2.
pub fn table_4_2(layout: Layout, attained: &AngleRanges) -> Finding {
    let table = angle_ranges(layout);
    let rounding = 1e-6;
    let same = Angle::ALL.into_iter().all(|angle| {
        let (ours, printed) = (attained.of(angle), table.of(angle));
        (ours.least_deg + rounding).floor() == printed.least_deg
            && (ours.greatest_deg - rounding).ceil() == printed.greatest_deg
    });
    let row = |ranges: &AngleRanges, write: fn(&AngleRange) -> String| {
        let ends = Angle::ALL.map(|angle| {
            let range = write(&ranges.of(angle));
            format!("θ{} {range}", angle.letter())
        });
        ends.join(", ") + "°"
    };
    Finding::claim(
        "table 4.2",
        format!("ranges of the angles on the {} layout", name(layout)),
        row(&table, |range| {
            format!("{} to {}", range.least_deg, range.greatest_deg)
        }),
        (
            row(attained, |range| {
                format!("{:.2} to {:.2}", range.least_deg, range.greatest_deg)
            }),
            same,
        ),
        "derived from the stops of §4.5 and θA ≥ θB, ends rounded outward to whole degrees",
    )
}

/// What §4.3 found of the arms beside a sweep, best first: a whole one or a part of it.
pub fn arms_of_the_sweep(ranked: &[Candidate]) -> Vec<Finding> {
    let same = |candidate: &&Candidate| candidate.l_ae == 0.9;
    let place = ranked.iter().position(|c| c.l_ae == 0.9 && c.l_ab == 0.9);
    let (Some(place), Some(best)) = (place, ranked.first()) else {
        return Vec::new();
    };
    let share = ranked.get(place).map_or(0.0, Candidate::score) / best.score();
    let well_spaced = |c: &Candidate| c.figures.map_or(0.0, |figures| figures.well_spaced_m2);
    let most = ranked.iter().filter(same).map(well_spaced);
    let most = most.fold(0.0, f64::max);
    let near = ranked.iter().filter(same);
    let mut near: Vec<f64> = near
        .filter(|c| well_spaced(c) > 0.99 * most)
        .map(|c| c.l_ab)
        .collect();
    near.sort_by(f64::total_cmp);
    let named: Vec<String> = near.iter().map(f64::to_string).collect();
    vec![
        Finding {
            place: "§4.3",
            statement: "L_AE and L_AB of about 90 % of L_ED yield the best workspace properties".to_owned(),
            stated: "selected by inspection".to_owned(),
            ours: format!(
                "0.9/0.9 is number {} of {} at {:.0} % of the best score ({}/{})",
                place + 1,
                ranked.len(),
                100.0 * share,
                best.l_ae,
                best.l_ab
            ),
            verdict: Verdict::CannotBeCompared,
            because: "the text states no criterion: the score is ours, well-spaced area over the square of the reach times the share of its rectangle"
                .to_owned(),
            account: None,
        },
        Finding::claim(
            "§4.3",
            "with L_AE = 0.9, the L_AB with the most area of well-spaced paths",
            "about 0.9",
            (named.join(", "), near.contains(&0.9)),
            "within 1 % of the most, which is what the grid's cells cost",
        ),
    ]
}

/// Whether the 4-brake linkage has as much well-spaced area as a scaled PTER (chapter 7).
pub fn like_pter(pter: &Figures, three: &Figures, four: &Figures) -> Finding {
    let share = well_spaced_percent;
    let finding = Finding::claim(
        "§7.1",
        "availability of local paths is equivalent to that of PTER",
        "equivalent",
        (
            format!(
                "paths at most 90° apart on {:.0} % of PTER's workspace, {:.0} % of the 4-brake, {:.0} % of the 3-brake; mean {:.0}, {:.0}, {:.0}°",
                share(pter),
                share(four),
                share(three),
                deg(pter.mean_rad),
                deg(four.mean_rad),
                deg(three.mean_rad)
            ),
            share(four) >= share(pter),
        ),
        "by the measure of §4.3; PTER with the arms and stops of the 3-brake layout, where its angles never exceed 85°",
    );
    match finding.verdict {
        Verdict::Disagrees => finding.accounted("availability-like-pter"),
        _ => finding,
    }
}
