//! This file is what a design is asked for: the thesis's layouts, or somebody's own lengths and limits.

use std::path::PathBuf;

use rigproof_model::linkage::check_arms;
use rigproof_model::linkage::device::{Brakes, Device};
use rigproof_model::linkage::limits::check_ranges;
use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, Arms, STOPS};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::{Dimension, Unit};
use rigproof_trace::rig::linkage::{self, Linkage};

use crate::outcome::Failure;

/// A linkage of one's own; without it both layouts of the thesis are drawn.
#[derive(clap::Args)]
pub struct Own {
    /// A linkage of one's own, as TOML
    #[arg(long, value_name = "TOML", conflicts_with_all = ["ae", "ed", "bc", "cd", "ab", "brakes"])]
    linkage: Option<PathBuf>,
    /// Length of arm AE with its unit, such as 26.4cm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, requires_all = ["ed", "ab"], allow_hyphen_values = true)]
    ae: Option<f64>,
    /// Length of arm ED
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, requires = "ae", allow_hyphen_values = true)]
    ed: Option<f64>,
    /// Distance of the base joints A and B
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, requires = "ae", allow_hyphen_values = true)]
    ab: Option<f64>,
    /// Length of arm BC; as AE if it is not given
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, requires = "ae", allow_hyphen_values = true)]
    bc: Option<f64>,
    /// Length of arm CD; as ED if it is not given
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, requires = "ae", allow_hyphen_values = true)]
    cd: Option<f64>,
    /// The braked joints; A,E,B where the base joints share an axis, else A,E,B,C
    #[arg(long, value_name = "JOINTS", value_parser = parse_brakes, requires = "ae")]
    brakes: Option<&'static [Joint]>,
    /// Where an angle of one's own linkage, and of the sweep, may lie, in degrees, such as C=15..160; may be repeated
    #[arg(long = "range", value_name = "ANGLE=LEAST..GREATEST", value_parser = parse_range)]
    ranges: Vec<(Angle, AngleRange)>,
}

/// A linkage to be drawn.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The beginning of its files' names.
    pub name: String,
    /// Its lengths.
    pub arms: Arms,
    /// Where its angles may lie.
    pub ranges: AngleRanges,
    /// Its braked joints.
    pub brakes: &'static [Joint],
    /// Whether it is a layout that the thesis built.
    pub is_layout: bool,
}

impl Shape {
    /// The linkage as a device.
    pub fn device(&self) -> Device {
        Device::Linkage {
            arms: self.arms,
            ranges: self.ranges,
            brakes: Brakes::Joints(self.brakes),
        }
    }

    fn layout(name: &str, layout: Layout) -> Shape {
        Shape {
            name: name.to_owned(),
            arms: rigproof_spec::geometry::arms(layout),
            ranges: rigproof_spec::geometry::angle_ranges(layout),
            brakes: layout.brakes(),
            is_layout: true,
        }
    }

    /// The lengths that the sweep of §4.3 found, before they were changed to simplify the design (figure 4.7).
    fn found() -> Shape {
        let l_ed_m = rigproof_spec::geometry::arms(Layout::FourBrake).l_ed_m;
        let arms = Arms {
            l_ae_m: 0.9 * l_ed_m,
            l_ed_m,
            l_bc_m: 0.9 * l_ed_m,
            l_cd_m: l_ed_m,
            l_ab_m: 0.9 * l_ed_m,
        };
        Shape {
            name: "ninety-percent".to_owned(),
            arms,
            ranges: STOPS,
            brakes: usual_brakes(&arms),
            is_layout: false,
        }
    }

    /// The side of its grid's cells if none was asked for: 300 along the longer side of its box, m.
    pub fn usual_step_m(&self) -> f64 {
        let [[left, low], [right, high]] = self.device().box_m();
        (right - left).max(high - low) / 300.0
    }
}

impl Own {
    /// The linkages to draw, the thesis's own two if no other is given, checked.
    ///
    /// # Errors
    /// A file cannot be used, or numbers are no linkage.
    pub fn shapes(&self) -> Result<Vec<Shape>, Failure> {
        let shapes = match (&self.linkage, self.ae, self.ed, self.ab) {
            (Some(path), ..) => {
                let read = Linkage::read(path)?;
                let named = read.brakes.as_deref();
                let brakes = match named {
                    Some(joints) => leaked(joints),
                    None => usual_brakes(&read.arms),
                };
                vec![self.limited(Shape {
                    name: file_name(&read.name),
                    arms: read.arms,
                    ranges: read.ranges,
                    brakes,
                    is_layout: false,
                })]
            }
            (None, Some(l_ae_m), Some(l_ed_m), Some(l_ab_m)) => {
                let arms = Arms {
                    l_ae_m,
                    l_ed_m,
                    l_bc_m: self.bc.unwrap_or(l_ae_m),
                    l_cd_m: self.cd.unwrap_or(l_ed_m),
                    l_ab_m,
                };
                vec![self.limited(Shape {
                    name: "own".to_owned(),
                    arms,
                    ranges: STOPS,
                    brakes: self.brakes.unwrap_or_else(|| usual_brakes(&arms)),
                    is_layout: false,
                })]
            }
            _ => vec![
                Shape::layout("three-brake", Layout::ThreeBrake),
                Shape::layout("four-brake", Layout::FourBrake),
                Shape::found(),
            ],
        };
        for shape in &shapes {
            check_arms(&shape.arms)?;
            check_ranges(&shape.ranges)?;
        }
        Ok(shapes)
    }

    /// The stops of the sweep: those of §4.5 with the ranges that were given.
    ///
    /// # Errors
    /// A range has no inside.
    pub fn sweep_ranges(&self) -> Result<AngleRanges, Failure> {
        let mut ranges = STOPS;
        for (angle, range) in &self.ranges {
            linkage::set(&mut ranges, *angle, *range);
        }
        check_ranges(&ranges)?;
        Ok(ranges)
    }

    /// Whether the thesis's own two layouts are drawn.
    pub fn is_thesis(&self) -> bool {
        self.linkage.is_none() && self.ae.is_none()
    }

    fn limited(&self, mut shape: Shape) -> Shape {
        for (angle, range) in &self.ranges {
            linkage::set(&mut shape.ranges, *angle, *range);
        }
        shape
    }
}

/// No cell of a grid lies in the workspace: the arms never meet, or only outside the ranges, or between the cells.
pub fn empty(shape: &Shape, step_m: f64) -> Failure {
    let Arms {
        l_ae_m,
        l_ed_m,
        l_bc_m,
        l_cd_m,
        l_ab_m,
    } = shape.arms;
    Failure::Input(format!(
        "the linkage `{}` has no workspace on a grid of {step_m:.4} m: its sides reach {:.4} m and {:.4} m, the base joints are \
         {l_ab_m:.4} m apart, and no cell is within the ranges of the angles; change the lengths, widen the ranges or give a \
         smaller --step",
        shape.name,
        l_ae_m + l_ed_m,
        l_bc_m + l_cd_m,
    ))
}

fn usual_brakes(arms: &Arms) -> &'static [Joint] {
    match arms.l_ab_m {
        0.0 => Layout::ThreeBrake.brakes(),
        _ => Layout::FourBrake.brakes(),
    }
}

/// The joints for the rest of the run, which draws one linkage.
fn leaked(joints: &[Joint]) -> &'static [Joint] {
    Box::leak(joints.to_vec().into_boxed_slice())
}

/// A name that can begin a file's name.
fn file_name(name: &str) -> String {
    let fits = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let name: String = name.to_lowercase().chars().map(fits).take(40).collect();
    if name.is_empty() {
        "own".to_owned()
    } else {
        name
    }
}

/// A length with its unit, m.
pub fn parse_length(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let ends = text.char_indices().map(|(at, _)| at).rev();
    let read = ends.filter_map(|at| {
        let (number, unit) = text.split_at(at);
        let number = number.trim().parse::<f64>().ok()?;
        Some((number, Unit::parse(unit)?))
    });
    let length = read.filter(|(_, unit)| unit.dimension == Dimension::LENGTH);
    let length = length.map(|(number, unit)| number * unit.to_si).next();
    length.ok_or_else(|| "give a number and a unit of length, such as 26.4cm or 12in".to_owned())
}

fn parse_brakes(text: &str) -> Result<&'static [Joint], String> {
    linkage::brakes(text).map(|joints| leaked(&joints))
}

fn parse_range(text: &str) -> Result<(Angle, AngleRange), String> {
    let advice = "write ANGLE=LEAST..GREATEST in degrees, such as C=15..160";
    let (letter, range) = text.split_once('=').ok_or(advice)?;
    let angle = Angle::ALL
        .into_iter()
        .find(|angle| angle.letter() == letter.trim())
        .ok_or_else(|| format!("`{letter}` is no angle; the angles are A, E, B, C, D"))?;
    let (least, greatest) = range.split_once("..").ok_or(advice)?;
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| advice.to_owned());
    Ok((angle, AngleRange::new(number(least)?, number(greatest)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_a_number_and_a_unit() {
        for (text, length_m) in [
            ("26.4cm", 0.264),
            ("12 in", 0.3048),
            ("-31.7e-2m", -0.317),
            ("305mm", 0.305),
        ] {
            let read = parse_length(text).unwrap();
            assert!((read - length_m).abs() < 1e-15, "{text}: {read}");
        }
        assert!(parse_length("NaN m").unwrap().is_nan());
        for text in ["", "26.4", "cm", "26.4N", "26,4cm", "m26"] {
            assert!(parse_length(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_range_names_its_angle() {
        let (angle, range) = parse_range("C=15.5..160").unwrap();
        assert_eq!(
            (angle, range.least_deg, range.greatest_deg),
            (Angle::C, 15.5, 160.0)
        );
        for text in ["C", "F=1..2", "C=1", "C=a..b"] {
            assert!(parse_range(text).is_err(), "{text}");
        }
        assert_eq!(file_name("My rig/2"), "my-rig-2");
    }
}
