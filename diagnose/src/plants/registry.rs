//! This file is the registry of plants, one line each, and the operations that work on a
//! description and a recording of any plant.

use crate::diagnose::{Diagnosis, Options, diagnose};
use crate::plant::{Described, Plant, Replayed, Simulated, Unsimulated};
use rand_pcg::Pcg64Mcg;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::Rig;
use rigproof_trace::rig::chain::ChainRig;
use rigproof_trace::rig::five_bar::FiveBar;
use rigproof_trace::{Trace, TraceError, store};
use std::path::Path;

/// A simulated recording of any plant, before sensor noise and quantisation.
pub type Replica = crate::plant::Replica<Measured>;

macro_rules! plants {
    ($(#[doc = $doc:literal] $name:ident($plant:ty),)+) => {
        /// What a rig file describes.
        #[derive(Clone, Debug, PartialEq)]
        #[expect(clippy::large_enum_variant, reason = "few are ever made")]
        pub enum Description {
            $(#[doc = $doc] $name($plant),)+
        }

        /// A recording in SI units.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Measured {
            $(#[doc = $doc] $name(<$plant as Plant>::Recording),)+
        }

        impl Description {
            /// The plant's name in reports.
            pub fn plant_name(&self) -> &'static str {
                match self {
                    $(Description::$name(own) => own.plant_name(),)+
                }
            }

            /// The rig's name as its description gives it.
            pub fn name(&self) -> &str {
                match self {
                    $(Description::$name(own) => own.rig_name(),)+
                }
            }

            /// Reads a description of any plant. `origin` is the file named in error messages.
            ///
            /// # Errors
            /// The text describes none of the plants, or is malformed.
            pub fn parse(text: &str, origin: &Path) -> Result<Description, TraceError> {
                $(if <$plant>::describes(text, origin)? {
                    return <$plant as Described>::read(text, origin).map(Description::$name);
                })+
                Rig::parse(text, origin).map(Description::Joint)
            }

            /// Converts a recording to SI units. `origin` is the file named in error messages.
            ///
            /// # Errors
            /// A channel of the rig is missing, or the unit in its header cannot be converted to
            /// the rig's.
            pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<Measured, TraceError> {
                self.taken(trace.clone(), origin)
            }

            /// The same of a recording that nobody needs afterwards: its numbers are turned where they stand.
            ///
            /// # Errors
            /// As [`Description::apply`].
            pub fn taken(&self, trace: Trace, origin: &Path) -> Result<Measured, TraceError> {
                match self {
                    $(Description::$name(own) => own.measured(trace, origin).map(Measured::$name),)+
                }
            }

            /// The description with the given units for some columns, overriding what their headers
            /// say.
            ///
            /// # Errors
            /// The rig has no such channel; the message lists those that it has.
            pub fn with_column_units(&self, units: &[(String, String)]) -> Result<Description, String> {
                match self {
                    $(Description::$name(own) => own.in_units(units).map(Description::$name),)+
                }
            }

            /// Reads a text recording whose dialect is partly known. Returns the recording, the
            /// dialect, and remarks on what was guessed, skipped or repaired.
            ///
            /// # Errors
            /// The file cannot be read, or as [`Description::apply`].
            pub fn read_text(&self, file: &Path, hints: &Hints) -> Result<(Measured, Dialect, Vec<String>), TraceError> {
                match self {
                    $(Description::$name(own) => {
                        own.read_csv(file, hints)
                            .map(|(recording, dialect, remarks)| (Measured::$name(recording), dialect, remarks))
                    })+
                }
            }

            /// Reads an MCAP recording, with remarks on how it was read.
            ///
            /// # Errors
            /// The file cannot be read, or as [`Description::apply`].
            pub fn read_mcap(&self, file: &Path) -> Result<(Measured, Vec<String>), TraceError> {
                match self {
                    $(Description::$name(own) => {
                        own.read_messages(file).map(|(recording, lines)| (Measured::$name(recording), lines))
                    })+
                }
            }

            /// Diagnoses several recordings of this rig together. The numbers are checked on
            /// `held_out`, another recording, if there is one.
            ///
            /// `None` if a recording belongs to another plant.
            pub fn diagnose(
                &self,
                recordings: &[Measured],
                held_out: Option<&Measured>,
                options: &Options,
            ) -> Option<Diagnosis> {
                match self {
                    $(Description::$name(own) => {
                        let of = |recording| match recording {
                            &Measured::$name(ref recording) => Some(recording),
                            _ => None,
                        };
                        let all = recordings.iter().map(of).collect::<Option<Vec<_>>>()?;
                        let held_out = match held_out {
                            Some(held_out) => Some(of(held_out)?),
                            None => None,
                        };
                        Some(diagnose(own, &all, held_out, options).map(Description::$name))
                    })+
                }
            }

            /// Simulates the recording that a rig with the numbers of `model` would have made.
            ///
            /// # Errors
            /// Why it cannot be simulated.
            pub fn replica(&self, model: &Description, recording: &Measured) -> Result<Replica, String> {
                match (self, model, recording) {
                    $((Description::$name(own), Description::$name(model), Measured::$name(recording)) => {
                        let replica = own.replica(model, recording)?;
                        Ok(Replica {
                            recording: Measured::$name(replica.recording),
                            noise: replica.noise,
                            how: replica.how,
                        })
                    })+
                    _ => Err("the recording is one of another plant".to_owned()),
                }
            }

            /// Simulates a model beside a recording. A free run restarts from the recorded state
            /// every `restart_s`.
            ///
            /// # Errors
            /// The recording is faulty, or the model cannot be simulated.
            pub fn simulated(
                &self,
                model: &Description,
                recording: &Measured,
                restart_s: f64,
            ) -> Result<Simulated, Unsimulated> {
                match (self, model, recording) {
                    $((Description::$name(own), Description::$name(model), Measured::$name(recording)) => {
                        own.simulated(model, recording, restart_s)
                    })+
                    _ => Err(Unsimulated::Model("the recording is one of another plant".to_owned())),
                }
            }

            /// Why a calibration does not belong to this rig; `None` if it does.
            pub fn refuses(&self, calibration: &Description) -> Option<String> {
                match (self, calibration) {
                    $((Description::$name(own), Description::$name(calibration)) => own.refuses(Some(calibration)),)+
                    $((Description::$name(own), _) => own.refuses(None),)+
                }
            }

            /// The end of a recording beside free runs of this description and of `after`; `None`
            /// if the plant has no such picture.
            pub fn replay(&self, after: &Description, recording: &Measured) -> Option<Replayed> {
                match (self, after, recording) {
                    $((Description::$name(own), Description::$name(after), Measured::$name(recording)) => {
                        own.replay(after, recording)
                    })+
                    _ => None,
                }
            }

            /// A calibration of this nominal description, without the effects that were found.
            pub fn without_found(&self, calibration: &Description) -> Description {
                match (self, calibration) {
                    $((Description::$name(own), Description::$name(calibration)) => {
                        Description::$name(own.without_found(calibration))
                    })+
                    (_, other) => other.clone(),
                }
            }

            /// The description in formats of other programs, as file names and texts.
            pub fn beside(&self) -> Vec<(&'static str, String)> {
                match self {
                    $(Description::$name(own) => own.beside(),)+
                }
            }

            /// The description as TOML.
            pub fn to_toml(&self) -> String {
                match self {
                    $(Description::$name(own) => own.written(),)+
                }
            }
        }

        impl Measured {
            /// The time stamps, s.
            pub fn time_s(&self) -> &[f64] {
                match self {
                    $(Measured::$name(own) => <$plant>::times_s(own),)+
                }
            }

            /// The recording reduced to the samples that are `true` in `kept`.
            pub fn only(&self, kept: &[bool]) -> Measured {
                match self {
                    $(Measured::$name(own) => Measured::$name(<$plant>::only(own, kept)),)+
                }
            }

            /// The recording with fresh sensor noise, quantised.
            pub(crate) fn sensed(&self, noise: [f64; 2], random: &mut Pcg64Mcg) -> Measured {
                match self {
                    $(Measured::$name(own) => Measured::$name(<$plant>::sensed(own, noise, random)),)+
                }
            }
        }
    };
}

// The first plant whose format the text has reads it.
plants! {
    #[doc = "The five-bar."] FiveBar(FiveBar),
    #[doc = "A serial arm."] Chain(ChainRig),
    #[doc = "A plant of one joint."] Joint(Rig),
}

impl Description {
    /// Reads a description of any plant from a TOML file.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Description::parse`].
    pub fn read(path: &Path) -> Result<Description, TraceError> {
        Description::parse(&store::read_text(path)?, path)
    }
}
