//! This file certifies a controller of an axis: it runs every trial and writes the certificate.

pub mod check;
mod words;

use std::path::{Path, PathBuf};

use rigproof_certify::axis::campaign::records;
use rigproof_certify::axis::certificate::Certificate;
use rigproof_certify::axis::controller::{Place, Source};
use rigproof_certify::axis::description::Description;
use rigproof_certify::axis::found::Found;
use rigproof_certify::axis::plan::{Plan, Sources};
use rigproof_certify::axis::trial;
use rigproof_certify::campaign::withdraw;
use rigproof_certify::controller::Failure as Broken;
use rigproof_report::certificate::axis::{Run, page};
use rigproof_trace::store::{read_text, write_aside};

use super::campaign::{self, CERTIFICATE, between_trials};
use super::compiled::Opened;
use super::{Args, sign};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::threads;

/// Whether a description is one of an axis.
///
/// # Errors
/// It is no TOML, or of no plant that is known.
pub fn describes(text: &str, file: &Path) -> Result<bool, Failure> {
    Ok(Description::describes(text, file)?)
}

/// Whether a certificate is one of an axis.
pub fn is_certificate(text: &str) -> bool {
    Certificate::is_one(text)
}

/// Runs every trial, and writes and says the certificate.
pub fn run(args: &Args, file: &Path, text: &str) -> Result<Outcome, Failure> {
    without_others(args)?;
    let description = Description::parse(text, file)?;
    let axis = Found::read(&read_text(&description.rig)?, &description.rig)?;
    let keys = args.sign.as_deref().map(sign::secret).transpose()?;
    let (new, old) = libraries(args, file, &description)?;
    let controller = args.compiled.opened_beside(&new)?;
    let baseline = match old {
        Some(old) => Some((args.compiled.opened_beside(&old)?, old)),
        None => None,
    };
    let samples = libm::round(args.seconds / description.asked.sample_s);
    let plan = Plan {
        name: description.name,
        controller: controller.of_axis(),
        baseline: baseline.as_ref().map(|(own, _)| own.of_axis()),
        axis,
        asked: description.asked,
        seed: args.seed.unwrap_or(1),
        scenarios: args.scenarios,
        ticks: (samples as u32).max(1),
    };
    let opened = [(&controller, &new)].into_iter();
    let opened = opened.chain(baseline.iter().map(|(own, old)| (own, old)));
    for (own, library) in opened {
        is_of_an_axis(own, library, &plan)?;
    }
    let baseline = baseline.as_ref().map(|(own, _)| own);
    certified(args, &plan, [Some(&controller), baseline], keys)
}

/// Runs the trials of a plan with its controller and its baseline.
fn certified(
    args: &Args,
    plan: &Plan,
    opened: [Option<&Opened>; 2],
    keys: Option<ed25519_compact::KeyPair>,
) -> Result<Outcome, Failure> {
    let [Some(controller), baseline] = opened else {
        return Err(Failure::Usage("no controller is named".to_owned()));
    };
    let sources = sources(controller, baseline);
    std::fs::create_dir_all(&args.out)
        .map_err(|error| Failure::unusable(&args.out, error.to_string()))?;
    let bar = progress::bar(plan.scenarios as usize, "trials");
    let threads = threads::pool(args.jobs)?;
    let records = threads.install(|| records(plan, &sources, &|| bar.inc(1)));
    drop(bar);
    let certificate = Certificate::new(plan, &records, campaign::tool()?)?;
    let run = worst(&certificate, &sources);
    let between = ended(&opened);
    if !between.is_empty() {
        return between_trials(&between, &args.out);
    }
    withdraw(&args.out)?;
    let (file, text) = (args.out.join(CERTIFICATE), certificate.to_json()?);
    write_aside(&file, text.as_bytes())?;
    let html = page(&certificate, run.as_ref());
    write_aside(&args.out.join("certificate.html"), html.as_bytes())?;
    if let Some(keys) = &keys {
        sign::write(keys, &file, text.as_bytes())?;
    }
    match args.json {
        true => print(text.trim_end())?,
        false => print(&words::certificate(&certificate, &file))?,
    };
    Ok(Outcome {
        checks_hold: certificate.may_go(),
    })
}

fn sources<'a>(controller: &'a Opened, baseline: Option<&'a Opened>) -> Sources<'a> {
    Sources {
        controller: controller.source(),
        baseline: baseline.map(|own| own.source() as &dyn Source),
    }
}

/// What went wrong where no trial could say it; ends all processes.
fn ended(opened: &[Option<&Opened>; 2]) -> Vec<String> {
    let each = opened.iter().flatten();
    each.flat_map(|own| own.ended()).collect()
}

/// The trial of the law that was broken first, or the one with the greatest error, run again.
fn worst(certificate: &Certificate, sources: &Sources<'_>) -> Option<Run> {
    let plan = &certificate.plan;
    let mut laws = certificate.laws.iter();
    let broken = laws.find_map(|own| Some((own.first_broken?, own.law.name())));
    let (index, words) = match broken {
        Some((index, law)) => (
            index,
            format!("Trial {index}, the first that broke the law {law}."),
        ),
        None => {
            let index = certificate.metrics.first()?.worst_scenario?;
            (
                index,
                format!("Trial {index}, whose error is the greatest."),
            )
        }
    };
    let told = trial::run(plan, sources.controller, index, false).told;
    let of = |pick: fn(&(rigproof_certify::axis::controller::Sensed, f64, f64)) -> f64| {
        told.iter().map(pick).collect::<Vec<f64>>()
    };
    Some(Run {
        words,
        time_s: of(|(sensed, ..)| f64::from(sensed.number))
            .into_iter()
            .map(|number| number * plan.asked.sample_s)
            .collect(),
        target: of(|(sensed, ..)| sensed.target_position),
        position: of(|(_, _, position)| *position),
        effort: of(|(_, effort, _)| *effort),
    })
}

/// The controller's library and the baseline's: of the command line, or of the description.
fn libraries(
    args: &Args,
    file: &Path,
    description: &Description,
) -> Result<(PathBuf, Option<PathBuf>), Failure> {
    let given = args.compiled.library().map(Path::to_owned);
    let Some(new) = given.or_else(|| description.controller.clone()) else {
        let problem =
            "nothing is to be certified: add a table [controller] with `library`, or --controller";
        return Err(Failure::unusable(file, problem.to_owned()));
    };
    let old = args.old.clone().or_else(|| description.baseline.clone());
    let is_asked = description.asked.regressions.iter().any(Option::is_some);
    if is_asked && old.is_none() {
        let problem = "nothing stands beside the controller: add a table [baseline] with `library`, or --old, or take [regressions] away";
        return Err(Failure::unusable(file, problem.to_owned()));
    }
    Ok((new, old))
}

/// Refuses a library that is no controller of an axis.
fn is_of_an_axis(own: &Opened, library: &Path, plan: &Plan) -> Result<(), Failure> {
    match own.source().begin(&plan.settings(), Place::New) {
        Err(Broken::Unusable(why)) => Err(Failure::unusable(library, why)),
        // Whatever else it does, trials say.
        _ => Ok(()),
    }
}

/// Refuses what only a five-bar's campaign has.
fn without_others(args: &Args) -> Result<(), Failure> {
    let others = [
        ("--shard", args.shard != [0, 1]),
        ("--search", args.search != 0),
        ("--calibration", args.calibration.is_some()),
    ];
    match others.into_iter().find(|(_, is_given)| *is_given) {
        None => Ok(()),
        Some((name, _)) => Err(Failure::Usage(format!(
            "{name} is of a five-bar's campaign: leave it away; the axis is what `rig` names in the description"
        ))),
    }
}
