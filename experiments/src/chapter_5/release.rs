//! This file lets the tip go under the spring of §5.4 and sets beside what happens what the text says of it.

use rigproof_model::linkage::inverse;
use rigproof_model::rig::release::{Release, Sample};
use rigproof_spec::geometry::arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::backlash_width_deg;
use rigproof_spec::units::deg_from_rad;

use super::thesis_rules;
use crate::outline::{self, cm, outline};
use crate::{Column, Curve, Error, Finding, Outcome, Panel, Picture, Table};

/// A release and what happened.
pub struct Run {
    release: Release,
    samples: Vec<Sample>,
    /// The tip by the thesis's own rules, where they need no model of the brake, m.
    by_rules_m: Option<Vec<[f64; 2]>>,
    /// The tip if the locked joint did not turn at all, m.
    ideal_m: Option<Vec<[f64; 2]>>,
}

/// Runs the releases of one figure: free (`None`) or with a brake locked.
pub fn figure(layout: Layout, locked: &[Option<Joint>]) -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    for locked in locked {
        let run = Run::of(layout, *locked)?;
        outcome.tables.push(run.table());
        outcome.pictures.push(run.picture()?);
        outcome.findings.extend(run.findings());
    }
    Ok(outcome)
}

impl Run {
    fn of(layout: Layout, locked: Option<Joint>) -> Result<Run, Error> {
        let refused = |error| Error::model("the release of the tip", error);
        let release = Release::of(layout, locked);
        let samples = release.run().map_err(refused)?;
        let by_rules_m = match thesis_rules::applies(&release) {
            true => Some(thesis_rules::tips_m(&release, samples.len()).map_err(refused)?),
            false => None,
        };
        let ideal_m = match locked {
            Some(joint) => Some(fixed(&release, joint, &samples)?),
            None => None,
        };
        Ok(Run {
            release,
            samples,
            by_rules_m,
            ideal_m,
        })
    }

    fn name(&self) -> String {
        match self.release.locked {
            None => "free".to_owned(),
            Some(joint) => format!("brake-{}-locked", joint.letter().to_lowercase()),
        }
    }

    fn column(&self, pick: impl Fn(&Sample) -> f64) -> Vec<f64> {
        self.samples.iter().map(pick).collect()
    }

    fn table(&self) -> Table {
        let mut columns = Vec::new();
        for (axis, pick) in [("tip x", 0), ("tip y", 1)] {
            let values = self.column(|sample| at(&sample.tip_m, pick));
            columns.push(Column::numbers(axis, "m", &values));
        }
        if let Some(tips_m) = &self.by_rules_m {
            for (axis, pick) in [("tip x by printed rules", 0), ("tip y by printed rules", 1)] {
                let values: Vec<f64> = tips_m.iter().map(|tip_m| at(tip_m, pick)).collect();
                columns.push(Column::numbers(axis, "m", &values));
            }
        }
        for joint in Joint::ALL {
            let (letter, index) = (joint.letter(), joint as usize);
            let theta = self.column(|sample| at(&sample.joint_angles_rad, index));
            columns.push(Column::numbers(format!("theta {letter}"), "rad", &theta));
        }
        for joint in self.release.layout.brakes() {
            let (letter, index) = (joint.letter(), *joint as usize);
            let torque = self.column(|sample| at(&sample.torques_nm, index));
            columns.push(Column::numbers(format!("torque {letter}"), "N·m", &torque));
        }
        Table::run(self.name(), &self.column(|sample| sample.time_s), columns)
    }

    fn picture(&self) -> Result<Picture, Error> {
        let release = &self.release;
        let time_s = self.column(|sample| sample.time_s);
        let tips_m: Vec<[f64; 2]> = self.samples.iter().map(|sample| sample.tip_m).collect();
        let mut drawn = vec![("simulation", &tips_m)];
        drawn.extend(
            self.by_rules_m
                .as_ref()
                .map(|tips| ("printed rules, 1 ms", tips)),
        );
        let fixed = self.ideal_m.as_ref().map(|tips| ("joint fixed", tips));
        let cm_of = |tips_m: &[[f64; 2]], axis: usize| -> Vec<f64> {
            tips_m.iter().map(|tip_m| cm(at(tip_m, axis))).collect()
        };
        let mut map = Vec::new();
        for (name, tips_m) in drawn.iter().chain(&fixed) {
            map.push(Curve::line(*name, &cm_of(tips_m, 0), &cm_of(tips_m, 1)));
        }
        map.extend([cylinder(release), outline(release.layout)?]);
        let over_time = |axis: usize, quantity: &str| {
            let curves = drawn
                .iter()
                .map(|(name, tips_m)| Curve::line(*name, &time_s, &cm_of(tips_m, axis)));
            Panel::new(("time", "s"), (quantity, "cm"), curves.collect())
        };
        let what = match release.locked {
            None => "free motion".to_owned(),
            Some(joint) => format!("brake {} locked", joint.letter()),
        };
        Ok(Picture {
            name: self.name(),
            title: format!("{} configuration, {what}", outline::name(release.layout)),
            subtitle: format!(
                "spring of {} N towards the cylinder; the data of the figure, force and places are lost",
                release.force_n
            ),
            panels: vec![
                Panel::new(("x", "cm"), ("y", "cm"), map).map(),
                over_time(0, "x"),
                over_time(1, "y"),
            ],
        })
    }

    fn findings(&self) -> Vec<Finding> {
        let layout = outline::name(self.release.layout);
        let end_s = self.samples.last().map_or(f64::NAN, |sample| sample.time_s);
        let way_cm = cm(self.travel_m());
        let beside = match &self.by_rules_m {
            Some(tips_m) => format!(
                "; the printed rules at 1 ms stay within {:.2} mm of it",
                1e3 * self.farthest_m(tips_m)
            ),
            None => String::new(),
        };
        let ours = format!("{way_cm:.1} cm in {end_s:.3} s{beside}");
        let because = "the data are in the figure only; force, cylinder and places are lost as well (gap release-setup)";
        let statement = match (self.release.locked, self.release.layout) {
            (None, Layout::ThreeBrake) => {
                "the simulation is slightly faster than the data".to_owned()
            }
            (None, _) => "negligible difference between simulation and data".to_owned(),
            (Some(joint), _) => format!(
                "negligible difference between simulation and data, brake {} locked",
                joint.letter()
            ),
        };
        let mut findings = vec![Finding::lost(
            "§5.4",
            format!("{layout}: {statement}"),
            ours,
            because,
        )];
        findings.extend(self.release.locked.map(|joint| self.single_freedom(joint)));
        findings.extend(self.release.locked.map(|joint| self.in_stuck_mode(joint)));
        findings
    }

    /// Whether a locked joint turns by no more than its backlash.
    fn single_freedom(&self, joint: Joint) -> Finding {
        let angles = self.column(|sample| at(&sample.joint_angles_rad, joint as usize));
        let first = angles.first().copied().unwrap_or(f64::NAN);
        let turned = angles.iter().map(|angle| deg_from_rad(angle - first).abs());
        let turned_deg = turned.fold(0.0, f64::max);
        let width_deg = backlash_width_deg(joint);
        let off_mm = 1e3
            * self
                .ideal_m
                .as_ref()
                .map_or(f64::NAN, |tips| self.farthest_m(tips));
        let letter = joint.letter();
        Finding::claim(
            "§1.1",
            format!("locking brake {letter} leaves the tip a single degree of freedom"),
            "a single degree of freedom",
            (
                format!(
                    "joint {letter} turns by {turned_deg:.3}°, the tip leaves its local SDOF path by {off_mm:.1} mm"
                ),
                turned_deg <= width_deg + 1e-9,
            ),
            format!(
                "the joint stays within its backlash of {width_deg}° (table 3.1), in which a locked brake does not hold"
            ),
        )
    }

    /// Whether a locked joint is stuck, as §5.4 takes for granted.
    fn in_stuck_mode(&self, joint: Joint) -> Finding {
        let held = |sample: &&Sample| sample.stuck.get(joint as usize) == Some(&true);
        let stuck = self.samples.iter().filter(held).count();
        let share = 100.0 * stuck as f64 / self.samples.len() as f64;
        let slips: Vec<String> = self
            .samples
            .chunk_by(|one, next| held(&one) == held(&next))
            .filter_map(|stretch| stretch.first().zip(stretch.last()))
            .filter(|(first, _)| !held(first))
            .map(|(first, last)| format!("{:.3} to {:.3} s", first.time_s, last.time_s))
            .collect();
        let ours = match slips.as_slice() {
            [] => "held throughout".to_owned(),
            slips => format!(
                "held in {share:.0} % of the samples; slips from {}",
                slips.join(", ")
            ),
        };
        let letter = joint.letter();
        Finding::claim(
            "§5.4",
            format!("where brake {letter} is locked, its joint is in stuck mode"),
            "in stuck mode",
            (ours, share > 70.0),
            "in seven samples of ten: it slips through its backlash, and where the load passes its yield torque",
        )
    }

    fn travel_m(&self) -> f64 {
        let ends = self.samples.first().zip(self.samples.last());
        ends.map_or(f64::NAN, |(first, last)| apart_m(first.tip_m, last.tip_m))
    }

    /// Greatest distance of the tip from another run's at the same time, m.
    fn farthest_m(&self, tips_m: &[[f64; 2]]) -> f64 {
        let pairs = self.samples.iter().zip(tips_m);
        pairs.fold(0.0, |most, (sample, tip_m)| {
            f64::max(most, apart_m(sample.tip_m, *tip_m))
        })
    }
}

/// The tip on the circle that a fixed joint leaves it, at each sample where it is nearest, m.
fn fixed(release: &Release, joint: Joint, samples: &[Sample]) -> Result<Vec<[f64; 2]>, Error> {
    let arms = arms(release.layout);
    let pose = inverse::pose(&arms, release.start_m)
        .map_err(|error| Error::model("the pose at the release", error))?;
    // A stops elbow E, about which the tip then turns; E stiffens the arm that turns about A.
    let centre_m = match joint {
        Joint::A => pose.point_e_m,
        Joint::B => pose.point_c_m,
        Joint::E => [-0.5 * arms.l_ab_m, 0.0],
        Joint::C => [0.5 * arms.l_ab_m, 0.0],
    };
    let radius_m = apart_m(centre_m, release.start_m);
    let [x_0, y_0] = centre_m;
    let nearest = |sample: &Sample| {
        let [x, y] = sample.tip_m;
        let scale = radius_m / apart_m(centre_m, sample.tip_m);
        [x_0 + scale * (x - x_0), y_0 + scale * (y - y_0)]
    };
    Ok(samples.iter().map(nearest).collect())
}

fn cylinder(release: &Release) -> Curve {
    let [x_0, y_0] = release.cylinder_m;
    let points = (0..=48).map(|k| libm::sincos(core::f64::consts::TAU * f64::from(k) / 48.0));
    let (x_cm, y_cm): (Vec<f64>, Vec<f64>) = points
        .map(|(sine, cosine)| {
            let r = release.radius_m;
            (cm(x_0 + r * cosine), cm(y_0 + r * sine))
        })
        .unzip();
    Curve::line("cylinder", &x_cm, &y_cm)
}

fn apart_m([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> f64 {
    libm::hypot(x_2 - x_1, y_2 - y_1)
}

/// One entry; not a number beyond the end.
fn at(values: &[f64], index: usize) -> f64 {
    values.get(index).copied().unwrap_or(f64::NAN)
}
