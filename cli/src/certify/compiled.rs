//! This file says which controllers a plan is run with: laws of the rig, or a compiled one that the command line names.

use std::path::{Path, PathBuf};

use rigproof_certify::axis::plan::Library;
use rigproof_certify::controller::Source;
use rigproof_certify::declared::Declared;
use rigproof_certify::foreign::{Between, Foreign, Limits};
use rigproof_certify::plan::{Plan, Sources, Subject, What};

use crate::controller::{Given, host};
use crate::outcome::Failure;

/// A compiled controller, if one is named.
#[derive(clap::Args)]
pub struct Compiled {
    /// A compiled controller behind rigproof_controller.h, in place of the table `controller`; what it promises stands in the table `declares`
    #[arg(long = "controller", value_name = "LIBRARY")]
    library: Option<PathBuf>,
    #[command(flatten)]
    given: Given,
}

/// A compiled controller at hand.
pub struct Opened {
    source: Foreign,
    limits: Limits,
    name: String,
}

impl Compiled {
    /// The shared library's file.
    pub fn library(&self) -> Option<&Path> {
        self.library.as_deref()
    }

    /// Opens it once, to see that it can be run.
    ///
    /// # Errors
    /// It cannot be read or run.
    pub fn opened(&self) -> Result<Option<Opened>, Failure> {
        self.opened_with(self.given.limits())
    }

    /// As [`Compiled::opened`], for something that was run before: with the limits that it had then.
    ///
    /// # Errors
    /// As [`Compiled::opened`], and where limits are given here too.
    pub fn opened_again(&self, subject: &Subject) -> Result<Option<Opened>, Failure> {
        self.without_limits()?;
        self.opened_with(match &subject.what {
            What::Given { process, .. } => process.unwrap_or_default(),
            What::BuiltIn(_) => Limits::default(),
        })
    }

    /// Refuses limits for something that was run before.
    pub fn without_limits(&self) -> Result<(), Failure> {
        match self.given.is_given() {
            false => Ok(()),
            true => Err(Failure::Usage(
                "a controller is run again with the limits it had, which the file says: leave --tick-ms, --start-ms, --memory-mb and --one-trial-a-process away"
                    .to_owned(),
            )),
        }
    }

    /// Opens another one beside it, with the same limits.
    ///
    /// # Errors
    /// As [`Compiled::opened`].
    pub fn opened_beside(&self, file: &Path) -> Result<Opened, Failure> {
        opened(file, self.given.limits())
    }

    fn opened_with(&self, limits: Limits) -> Result<Option<Opened>, Failure> {
        let library = self.library.as_deref();
        library.map(|file| opened(file, limits)).transpose()
    }
}

/// Opens a library once, to see that it can be run.
///
/// # Errors
/// It cannot be read or run.
pub fn opened(file: &Path, limits: Limits) -> Result<Opened, Failure> {
    let unusable = |why: String| Failure::unusable(file, why);
    let source = Foreign::new(file, host()?, limits);
    let source = source.map_err(|failure| unusable(failure.to_string()))?;
    source
        .check()
        .map_err(|failure| unusable(failure.to_string()))?;
    let name = file.file_name().unwrap_or(file.as_os_str());
    Ok(Opened {
        source,
        limits,
        name: name.to_string_lossy().into_owned(),
    })
}

impl Opened {
    /// What makes its controllers.
    pub const fn source(&self) -> &Foreign {
        &self.source
    }

    /// As a library of the plan of an axis.
    pub fn of_axis(&self) -> Library {
        Library {
            name: self.name.clone(),
            sha256: self.source.sha256().to_owned(),
            process: self.limits,
            lacks: self.source.lacks().to_vec(),
        }
    }

    /// As the subject of a plan, with what is declared of it.
    pub fn subject(&self, declared: Declared) -> Subject {
        Subject {
            what: What::Given {
                name: self.name.clone(),
                sha256: self.source.sha256().to_owned(),
                process: Some(self.limits),
                lacks: self.source.lacks().to_vec(),
            },
            declared,
        }
    }

    /// What went wrong where no trial could say it, a line each; ends its processes.
    pub fn ended(&self) -> Vec<String> {
        self.source.end();
        let between = self.source.between_trials();
        let line = |own: &Between| match own.times {
            1 => own.what.clone(),
            times => format!("{} ({times} times)", own.what),
        };
        between.iter().map(line).collect()
    }
}

/// What makes the controllers of a plan.
///
/// # Errors
/// The plan is about a compiled controller, and it or another one is at hand.
pub fn sources<'a>(plan: &'a Plan, compiled: Option<&'a Opened>) -> Result<Sources<'a>, Failure> {
    let baseline = plan.baseline.as_ref().and_then(Subject::source);
    let controller = subject(&plan.controller, compiled)?;
    Ok(Sources {
        controller,
        baseline,
    })
}

/// What makes a controller.
///
/// # Errors
/// As [`sources`].
pub fn subject<'a>(
    subject: &'a Subject,
    compiled: Option<&'a Opened>,
) -> Result<&'a dyn Source, Failure> {
    let (name, sha256) = match &subject.what {
        What::BuiltIn(law) => return Ok(law),
        What::Given { name, sha256, .. } => (name, sha256),
    };
    match compiled {
        Some(own) if own.source.sha256() == sha256 => Ok(&own.source),
        Some(own) => Err(Failure::Input(format!(
            "{} is another controller: its SHA-256 is {}, that of {name} was {sha256}",
            own.name,
            own.source.sha256()
        ))),
        None => Err(Failure::Usage(format!(
            "this is about the compiled controller {name}: name it with --controller"
        ))),
    }
}
