//! This file lays out a folder to begin with: a rig description, a recording that disagrees with it, and what to do with them.

use std::path::PathBuf;

use rigproof_blind::{Case, Plant, Stratum, make, open};
use rigproof_certify::description::schema as certify_schema;
use rigproof_trace::rig::SCHEMA_LINE;
use rigproof_trace::rig::schema::schema_text;
use rigproof_trace::store::Folder;
use serde_json::json;

use crate::blind::{contents, parse_plant};
use crate::outcome::{Failure, Outcome, print};
use crate::schema;

/// What is to be begun.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder to make
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// The plant: axis (command in, position out), bench (motion in, force or torque out) or rig (the five-bar)
    #[arg(long, value_parser = parse_plant, default_value = "axis")]
    plant: Plant,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
The folder holds rig.toml (what a recording's channels mean, and which physics the model has), recording.csv (an example
with a cause that rig.toml leaves out) and README.md (three commands, and how to go on with your own recordings); for the
five-bar also certify.toml (a changed controller). Nothing that is there already is touched.

Example:
  rigproof new my-lab
  rigproof new my-lab --plant rig";

/// The example of each plant: its seed, and what kind of case that seed makes.
const EXAMPLES: [(Plant, u64, Stratum); 3] = [
    (Plant::Axis, 48, Stratum::Masked),
    (Plant::Bench, 41, Stratum::Single),
    (Plant::Rig, 9, Stratum::Single),
];

fn example(plant: Plant) -> (u64, Stratum) {
    let own = EXAMPLES.iter().find(|(of, ..)| *of == plant);
    own.map_or((0, Stratum::Single), |(_, seed, stratum)| (*seed, *stratum))
}

const RIG_HEAD: &str = "\
# What the channels of a recording mean, and which physics the model has. A channel has the name and the unit of its column; `quantum` is
# the smallest step it can show, `noise` the standard deviation of a sample, both in that unit. A number whose `status` is \"unknown\" is
# fitted, one that is \"known\" is not. For a recording of yours: rigproof inspect YOURS.csv --write-rig YOURS.toml
";

/// Lays the folder out.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let folder = Folder::begin(&args.folder)?;
    let (seed, stratum) = example(args.plant);
    let case = make(args.plant, seed, Some(stratum))?;
    let [recording, rig, _] = contents(&case)?;
    let line = format!("{SCHEMA_LINE}\n").into_bytes();
    let plain = rig.strip_prefix(&*line).unwrap_or(&rig);
    let rig = [&line, RIG_HEAD.as_bytes(), plain].concat();
    let mut files = vec![
        ("README.md", readme(args, &case)?.into_bytes()),
        ("rig.toml", rig),
        ("recording.csv", recording),
        (schema::FILE, schema_text().into_bytes()),
    ];
    if args.plant == Plant::Rig {
        let kept = include_str!("../../certify/example.toml");
        let (_, certify) = kept.split_once('\n').unwrap_or(("", kept));
        let text = format!("{}\n{certify}", certify_schema::SCHEMA_LINE);
        files.push(("certify.toml", text.into_bytes()));
        files.push((
            schema::CERTIFY_FILE,
            certify_schema::schema_text().into_bytes(),
        ));
    }
    for (name, bytes) in &files {
        folder.write(name, bytes)?;
    }
    folder.hand_over()?;
    let paths = files
        .iter()
        .map(|(name, _)| args.folder.join(name).display().to_string());
    let paths: Vec<String> = paths.collect();
    if args.json {
        return print(&json!({ "plant": args.plant.name(), "files": paths }).to_string());
    }
    print(&format!(
        "Files\n  {}\nNext\n  cd {}\n  rigproof diagnose recording.csv --rig rig.toml",
        paths.join("\n  "),
        crate::shell::quoted(&args.folder.display().to_string()),
    ))
}

fn readme(args: &Args, case: &Case) -> Result<String, Failure> {
    let name = args.folder.file_name().unwrap_or(args.folder.as_os_str());
    let (seed, stratum) = example(args.plant);
    let hidden = open(&case.sealed)?.effects;
    let hidden: Vec<String> = hidden
        .iter()
        .map(|effect| match &effect.joint {
            Some(joint) => format!("`{}` at joint {joint}", effect.mechanism),
            None => format!("`{}`", effect.mechanism),
        })
        .collect();
    let certify = match args.plant {
        Plant::Rig => {
            "\nBefore a changed controller goes on the rig, say what changes in `certify.toml`, and:\n\n    rigproof certify certify.toml --scenarios 200\n"
        }
        _ => "",
    };
    Ok(format!(
        "\
# {}

`rig.toml` describes a rig, `recording.csv` is a recording of it, and the two disagree: the description lacks something. In this folder:

    rigproof inspect recording.csv
    rigproof diagnose recording.csv --rig rig.toml
    rigproof simulate recording.csv --rig rig.toml --calibration recording-diagnosis/calibration.toml

The first says what is in the file. The second finds out where the two disagree and what was left out, and writes the folder
`recording-diagnosis`. The third runs the model with what was found.

## Your own rig

    rigproof inspect yours.csv --write-rig yours.toml

begins a description of your recording; complete it where it says \"fill in\", and diagnose it as above. Every verb explains itself: `rigproof
diagnose --help`.
{certify}
## What rig.toml lacks

See what the diagnosis says before you read on. The recording is what `rigproof blind make --plant {} --seed {seed} --stratum {} --out case` makes; it
hides {}.
",
        name.display(),
        args.plant.name(),
        stratum.name(),
        hidden.join(" and ")
    ))
}
