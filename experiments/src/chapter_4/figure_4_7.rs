//! Figure 4.7: the traverse of a workspace by which arm lengths were compared.

use rigproof_model::linkage::device::{Brakes, Device};
use rigproof_model::linkage::paths::{directions_rad, greatest_angle_rad};
use rigproof_model::linkage::sweep::{Candidate, candidate};
use rigproof_model::linkage::workspace;
use rigproof_spec::geometry::{Arms, STOPS, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use super::layouts::{Spot, base, deg, figures, locked, outline, spots};
use super::statements;
use crate::table::Column;
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "4.7",
    title: "Local SDOF paths for L_ED = L_AB = .9",
    what: "Lengths in units of L_ED, within the stops of §4.5: the paths at every tenth of L_ED, and the sweep along the two lines through 0.9/0.9 (`rigproof design` sweeps all 420 pairs). The text names neither increment nor stops.",
    run,
};

/// The lengths of the figure, `L_ED` being the unit.
const ARMS: Arms = Arms {
    l_ae_m: 0.9,
    l_ed_m: 1.0,
    l_bc_m: 0.9,
    l_cd_m: 1.0,
    l_ab_m: 0.9,
};
/// Increment of the traverse that is drawn, and of the one that is counted.
const DRAWN: f64 = 0.1;
const COUNTED: f64 = 0.01;

fn run() -> Result<Outcome, Error> {
    let refused = |problem| Error::model("the traverse", problem);
    let device = Device::Linkage {
        arms: ARMS,
        ranges: STOPS,
        brakes: Brakes::Joints(Layout::FourBrake.brakes()),
    };
    let spots = spots(&device, DRAWN)?;
    let boundary = workspace::boundary(&device, 2.0 * COUNTED).map_err(refused)?;
    let figures = figures(&workspace::map(&device, COUNTED).map_err(refused)?)?;
    let mut ranked = lines_of_the_sweep()?;
    let panel = Panel::new(("x / L_ED", ""), ("y / L_ED", ""), {
        let mut curves: Vec<Curve> = Joint::ALL
            .into_iter()
            .enumerate()
            .map(|(index, joint)| strokes(&locked(joint), &spots, index))
            .collect();
        curves.push(base(&ARMS));
        curves.push(outline("end of the workspace", &boundary));
        curves
    });
    let traverse = Picture {
        name: "paths".to_owned(),
        title: "Local SDOF paths for L_AE = L_AB = 0.9".to_owned(),
        subtitle: "the way the tip can go while one brake is locked, at every tenth of L_ED; the print says L_ED for L_AE"
            .to_owned(),
        panels: vec![panel.map()],
    };
    let lines = sweep_picture(&ranked);
    ranked.sort_by(|a, b| b.score().total_cmp(&a.score()));
    let mut findings = vec![misnamed(), changed_slightly()];
    findings.push(Finding::number(
        "§4.3",
        "length chosen for L_ED",
        (30.5, 12.0 * 2.54, "cm"),
        0.05,
        "half the last printed digit of 30.5 cm (12.0 in)",
    ));
    findings.push(statements::in_limits("0.9/0.9", &figures));
    findings.extend(statements::arms_of_the_sweep(&ranked));
    Ok(Outcome {
        tables: vec![path_table(&spots), sweep_table(&ranked)],
        pictures: vec![traverse, lines],
        findings,
    })
}

fn misnamed() -> Finding {
    let built = arms(Layout::FourBrake);
    let ours = format!(
        "built are L_AE {:.1} % and L_AB {:.1} % of L_ED",
        100.0 * built.l_ae_m / built.l_ed_m,
        100.0 * built.l_ab_m / built.l_ed_m
    );
    Finding::claim(
        "§4.3, figure 4.7",
        "the lengths that are about 90 %",
        "L_ED and L_AB",
        (ours, false),
        "L_ED is the length of 1 that the others are given in; the 90 % are L_AE and L_AB",
    )
    .accounted("arms-of-ninety-percent")
}

fn changed_slightly() -> Finding {
    let built = arms(Layout::FourBrake);
    let off = |length_m: f64| 100.0 * (length_m / (0.9 * built.l_ed_m) - 1.0);
    let (ae, ab) = (off(built.l_ae_m), off(built.l_ab_m));
    Finding::claim(
        "§4.3, table 4.1",
        "the remaining arm lengths were changed from 90 %",
        "slightly",
        (
            format!("L_AE by {ae:.1} %, L_AB by {ab:.1} %"),
            ae.abs() < 5.0 && ab.abs() < 5.0,
        ),
        "under 5 %: less than half an increment of the sweep",
    )
}

/// The strokes of one brake's paths.
fn strokes(name: &str, spots: &[Spot], brake: usize) -> Curve {
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for Spot { tip_m, forces } in spots {
        let [tip_x, tip_y] = *tip_m;
        if let Some(direction) = directions_rad(forces).get(brake) {
            let (sine, cosine) = libm::sincos(*direction);
            let half = 0.42 * DRAWN;
            x.extend([tip_x - half * cosine, tip_x + half * cosine, f64::NAN]);
            y.extend([tip_y - half * sine, tip_y + half * sine, f64::NAN]);
        }
    }
    Curve::line(name, &x, &y)
}

fn path_table(spots: &[Spot]) -> Table {
    let column = |name: String, unit: &str, of: &dyn Fn(&Spot) -> f64| {
        Column::numbers(name, unit, &spots.iter().map(of).collect::<Vec<f64>>())
    };
    let mut columns = vec![
        column("x".to_owned(), "", &|spot| spot.tip_m[0]),
        column("y".to_owned(), "", &|spot| spot.tip_m[1]),
    ];
    columns.extend(Joint::ALL.into_iter().enumerate().map(|(index, joint)| {
        let path = format!("path_{}", joint.letter().to_lowercase());
        column(path, "°", &|spot| {
            let directions = directions_rad(&spot.forces);
            directions.get(index).map_or(f64::NAN, |path| deg(*path))
        })
    }));
    columns.push(column("greatest_angle".to_owned(), "°", &|spot| {
        deg(greatest_angle_rad(&spot.forces))
    }));
    Table::new("paths", columns)
}

/// The pairs of the sweep with `L_AE` = 0.9 or `L_AB` = 0.9.
fn lines_of_the_sweep() -> Result<Vec<Candidate>, Error> {
    rigproof_model::linkage::sweep::pairs()
        .filter(|pair| pair.contains(&0.9))
        .map(|pair| candidate(pair, &STOPS).map_err(|e| Error::model("the sweep", e)))
        .collect()
}

fn sweep_picture(candidates: &[Candidate]) -> Picture {
    let best = candidates.iter().map(Candidate::score).fold(0.0, f64::max);
    let well_spaced = |c: &Candidate| c.figures.map_or(0.0, |figures| figures.well_spaced_m2);
    let most = candidates.iter().map(well_spaced).fold(0.0, f64::max);
    let panel = |axis: &str, on: fn(&Candidate) -> bool, length: fn(&Candidate) -> f64| {
        let on: Vec<&Candidate> = candidates.iter().filter(|c| on(c)).collect();
        let x: Vec<f64> = on.iter().map(|c| length(c)).collect();
        let curve = |name: &str, of: &dyn Fn(&Candidate) -> f64| {
            Curve::line(name, &x, &on.iter().map(|c| of(c)).collect::<Vec<f64>>())
        };
        let curves = vec![
            curve("score of rigproof design", &|c| c.score() / best),
            curve("area of well-spaced paths", &|c| well_spaced(c) / most),
        ];
        Panel::new((axis, ""), ("share of the greatest", ""), curves)
    };
    Picture {
        name: "sweep".to_owned(),
        title: "Sweep of the arm lengths along the lines through 0.9/0.9".to_owned(),
        subtitle: "above L_AE = 0.9, below L_AB = 0.9, in units of L_ED; each curve over its greatest value on both lines".to_owned(),
        panels: vec![
            panel("L_AB / L_ED", |c| c.l_ae == 0.9, |c| c.l_ab),
            panel("L_AE / L_ED", |c| c.l_ab == 0.9, |c| c.l_ae),
        ],
    }
}

fn sweep_table(ranked: &[Candidate]) -> Table {
    let column = |name: &str, of: fn(&Candidate) -> f64| {
        Column::numbers(name, "", &ranked.iter().map(of).collect::<Vec<f64>>())
    };
    Table::new(
        "sweep",
        vec![
            column("l_ae", |c| c.l_ae),
            column("l_ab", |c| c.l_ab),
            column("score", Candidate::score),
            column("area", |c| c.figures.map_or(0.0, |f| f.area_m2)),
            column("well_spaced", |c| {
                c.figures.map_or(0.0, |f| f.well_spaced_m2)
            }),
            column("fill", |c| c.figures.map_or(f64::NAN, |f| f.fill)),
        ],
    )
}
