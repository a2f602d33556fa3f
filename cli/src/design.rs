//! This file compares linkages: how large their workspaces are, how evenly their paths are spread, and which lengths rank best.

mod shape;
mod tables;
mod text;
mod write;

use std::path::PathBuf;

use rayon::prelude::*;
use rigproof_model::displays::with_local_paths;
use rigproof_model::linkage::device::Concept;
use rigproof_model::linkage::sweep::{self, Candidate};
use rigproof_model::linkage::workspace::{self, Boundary, Figures, Map};
use rigproof_spec::geometry::{AngleRanges, STOPS};
use rigproof_trace::store::Folder;

use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::threads;
use shape::{Own, Shape, parse_length};

/// What is to be designed.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(flatten)]
    own: Own,
    /// Side of the grid's cells; a 300th of the box around the workspace if it is not given
    #[arg(long, value_name = "LENGTH", value_parser = parse_length, allow_hyphen_values = true)]
    step: Option<f64>,
    /// Leave the sweep of arm lengths out
    #[arg(long)]
    no_sweep: bool,
    /// Pairs of lengths that are traversed at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    jobs: usize,
    /// The folder to write
    #[arg(long, value_name = "FOLDER", default_value = "rigproof-design")]
    out: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Without lengths the two layouts of the thesis are drawn, and 0.9/0.9 beside them. The folder holds, of each linkage, the map of the
greatest angle between adjacent paths, the map of the paths and the boundary, as SVG and CSV; the sweep; and report.json.
The sweep goes over L_AE and L_AB in units of L_ED, within the stops of the thesis and the ranges given by --range.

A linkage in TOML: `bc`, `cd`, `angles` and `brakes` may be left out.
  name = \"wide\"
  brakes = \"A, E, B, C\"
  [lengths]
  ae = { value = 26.4, unit = \"cm\" }
  ed = { value = 30.5, unit = \"cm\" }
  ab = { value = 26.7, unit = \"cm\" }
  [angles]
  c = { least = 10, greatest = 150, unit = \"deg\" }

Examples:
  rigproof design
  rigproof design --ae 26.4cm --ed 30.5cm --ab 20cm --range C=15..160 --no-sweep --out wide
  rigproof design --linkage wide.toml --json";

/// A linkage with everything that is computed of it.
pub(crate) struct Drawn {
    shape: Shape,
    map: Map,
    figures: Figures,
    boundary: Boundary,
    attained: Option<AngleRanges>,
}

/// A concept of §4.2 with its figures.
pub(crate) struct Compared {
    concept: Concept,
    figures: Option<Figures>,
}

/// Everything that a design found.
pub(crate) struct Design {
    drawn: Vec<Drawn>,
    concepts: Vec<Compared>,
    /// The displays of chapter 2 that have local paths.
    displays: Vec<(&'static str, Option<Figures>)>,
    /// Best first.
    ranked: Vec<Candidate>,
    is_thesis: bool,
}

/// Draws, compares, sweeps and writes the folder.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let shapes = args.own.shapes()?;
    let ranges = args.own.sweep_ranges()?;
    if args.no_sweep && args.own.is_thesis() && ranges != STOPS {
        let advice = "--range changes a linkage of one's own and the sweep; give lengths, or leave --no-sweep out";
        return Err(Failure::Usage(advice.to_owned()));
    }
    let folder = Folder::begin(&args.out)?;
    let mark = progress::spinner("traversing");
    let drawn = shapes.into_iter().map(|shape| draw(shape, args.step));
    let drawn = drawn.collect::<Result<Vec<Drawn>, Failure>>()?;
    let concepts = concepts()?;
    let displays = displays()?;
    drop(mark);
    let ranked = match args.no_sweep {
        true => Vec::new(),
        false => swept(&ranges, args.jobs)?,
    };
    let design = Design {
        drawn,
        concepts,
        displays,
        ranked,
        is_thesis: args.own.is_thesis() && ranges == STOPS,
    };
    let files = write::files(&folder, &design)?;
    folder.finish()?;
    if args.json {
        return print(&tables::json(&design).to_string());
    }
    print(&text::report(&design, &args.out, &files))
}

fn draw(shape: Shape, step_m: Option<f64>) -> Result<Drawn, Failure> {
    let device = shape.device();
    let map = workspace::map(&device, step_m.unwrap_or_else(|| shape.usual_step_m()))?;
    let figures = map.figures();
    let figures = figures.ok_or_else(|| shape::empty(&shape, map.grid.step_m))?;
    Ok(Drawn {
        boundary: workspace::boundary(&device, map.grid.step_m)?,
        attained: workspace::attained_ranges(&shape.arms, &stops(&shape))?,
        shape,
        map,
        figures,
    })
}

/// What bounds a linkage: of the thesis's own layouts the stops of §4.5, from which table 4.2 is derived.
fn stops(shape: &Shape) -> AngleRanges {
    match shape.is_layout {
        true => STOPS,
        false => shape.ranges,
    }
}

fn concepts() -> Result<Vec<Compared>, Failure> {
    let compared = Concept::ALL.into_iter().map(|concept| {
        let figures = workspace::map(&concept.device(), CONCEPT_STEP_M)?.figures();
        Ok(Compared { concept, figures })
    });
    compared.collect()
}

fn displays() -> Result<Vec<(&'static str, Option<Figures>)>, Failure> {
    let compared = with_local_paths().into_iter().map(|(name, device)| {
        let figures = workspace::map(&device, CONCEPT_STEP_M)?.figures();
        Ok((name, figures))
    });
    compared.collect()
}

/// Side of the cells in which concepts and displays are compared, m.
const CONCEPT_STEP_M: f64 = 0.003;

/// Traverses every pair of the sweep, best first; equal scores keep the order of the pairs.
fn swept(ranges: &AngleRanges, jobs: usize) -> Result<Vec<Candidate>, Failure> {
    let threads = threads::pool(jobs)?;
    let pairs: Vec<[f64; 2]> = sweep::pairs().collect();
    let bar = progress::bar(pairs.len(), "pairs of lengths");
    let one = |pair: &[f64; 2]| {
        let candidate = sweep::candidate(*pair, ranges);
        bar.inc(1);
        candidate
    };
    let candidates = threads.install(|| pairs.par_iter().map(one).collect::<Result<Vec<_>, _>>());
    let mut ranked = candidates?;
    ranked.sort_by(|a, b| b.score().total_cmp(&a.score()));
    match ranked.first().map(Candidate::score) {
        Some(best) if best > 0.0 => Ok(ranked),
        _ => Err(Failure::Input(
            "no pair of lengths of the sweep has well-spaced paths within the ranges; widen them or give --no-sweep".into(),
        )),
    }
}
