//! This file says where the repository obeys an equation or a section of the thesis, what witnesses it, and what is known to be wrong with it.

mod citation;
mod equation;
mod record;
mod repository;

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::outcome::{Failure, Outcome, print};
use crate::text::{join, section};
use citation::{Citation, Kind};
use equation::Equation;
use record::Record;
use repository::Repository;

/// What is looked up.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The number of an equation of the thesis, such as 5.36 or A.7, or of a section, such as §2.2.1
    #[arg(value_name = "NUMBER")]
    number: String,
    /// The repository, or a folder in it; the current folder if it is not given
    #[arg(long, value_name = "FOLDER")]
    root: Option<PathBuf>,
    /// Print the answer as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Read are spec/thesis (equations.md, sections.md, errata.toml, gaps.toml) and every line `//= thesis (5.36)` or
`//= thesis section 2.2.1` of the repository's Rust sources.

Exit codes:
  0  shown
  1  shown, and neither code and a witness nor an erratum or gap stand for it
  2  the command line is wrong, or the thesis has no equation or section of that number
  3  there is no repository, or a file cannot be read

Examples:
  rigproof cite 5.36
  rigproof cite §2.2.1
  rigproof cite 3.3 --json";

/// An equation with everything that stands for it.
struct Cited {
    equation: Equation,
    citations: Vec<Citation>,
    errata: Vec<Record>,
    gaps: Vec<Record>,
    /// Equations whose line names this one.
    named_by: Vec<Equation>,
}

/// Looks the equation up and prints what is found.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let start = args.root.clone().unwrap_or_else(|| PathBuf::from("."));
    let repository = Repository::around(&start)?;
    let equations = equation::all(&repository)?;
    let equation = equation::find(&equations, &args.number).map_err(Failure::Usage)?;
    let sources = repository.sources()?;
    let concerns = |kind| -> Result<Vec<Record>, Failure> {
        let mut records = record::all(&repository, kind)?;
        records.retain(|record| record.concerns(&equation.number));
        for record in &mut records {
            record.locate(&sources);
        }
        Ok(records)
    };
    let mut citations: Vec<Citation> = sources.iter().flat_map(citation::of).collect();
    citations.retain(|citation| citation.equation == equation.number);
    let named_by = equations.iter().filter(|other| {
        other.number != equation.number && other.says.contains(&equation.in_brackets())
    });
    let cited = Cited {
        errata: concerns(record::Kind::Erratum)?,
        gaps: concerns(record::Kind::Gap)?,
        named_by: named_by.cloned().collect(),
        equation,
        citations,
    };
    match args.json {
        true => print(&cited.json().to_string())?,
        false => print(&cited.text())?,
    };
    Ok(Outcome {
        checks_hold: cited.is_accounted_for(),
    })
}

impl Cited {
    fn of(&self, kind: Kind) -> impl Iterator<Item = &Citation> {
        self.citations.iter().filter(move |c| c.kind == kind)
    }

    /// The rule that the tests of the repository hold every equation to.
    fn is_accounted_for(&self) -> bool {
        let tied = self.of(Kind::Code).next().is_some() && self.of(Kind::Test).next().is_some();
        let mut records = self.errata.iter().chain(&self.gaps);
        let is_section = self.equation.is_section();
        tied || records.any(|record| is_section || record.is_of(&self.equation.number))
    }

    fn text(&self) -> String {
        let equation = &self.equation;
        let head = [
            format!("{}  {}", equation.in_brackets(), equation.says),
            format!("  {}", equation.symbols),
            format!("  {}:{}", equation.file, equation.line),
        ];
        let places = |kind: Kind| {
            let lines = self.of(kind).map(Citation::line_of_text);
            let mut lines: Vec<String> = lines.collect();
            if lines.is_empty() && kind != Kind::Proof {
                lines.push("  none".to_owned());
            }
            lines
        };
        let records = |records: &[Record]| -> Vec<String> {
            records.iter().flat_map(Record::lines_of_text).collect()
        };
        let named = self
            .named_by
            .iter()
            .map(|other| format!("  {}  {}", other.in_brackets(), other.says));
        join([
            head.to_vec(),
            section("Code", places(Kind::Code)),
            section("Tests", places(Kind::Test)),
            section("Proofs", places(Kind::Proof)),
            section("Errata", records(&self.errata)),
            section("Gaps", records(&self.gaps)),
            section("Named by", named),
        ])
    }

    fn json(&self) -> Value {
        let of = |kind: Kind| self.of(kind).map(Citation::json).collect::<Value>();
        json!({
            "number": self.equation.number, "says": self.equation.says, "symbols": self.equation.symbols,
            "file": self.equation.file, "line": self.equation.line,
            "code": of(Kind::Code), "tests": of(Kind::Test), "proofs": of(Kind::Proof),
            "errata": self.errata.iter().map(Record::json).collect::<Value>(),
            "gaps": self.gaps.iter().map(Record::json).collect::<Value>(),
            "named_by": self.named_by.iter().map(|other| other.number.as_str()).collect::<Value>(),
        })
    }
}
